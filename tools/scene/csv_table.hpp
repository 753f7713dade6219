#pragma once

#include "tools/scene/table.hpp"

namespace tamp::tools
{

/// Reads a text file: lines starting with # are comments, the first other line names the columns with their units, such
/// as `pressure[Pa]`, and each further line has one number a column, separated by commas. The columns are just those
/// asked for, in any order. Throws InputError, all problems with file and line at once, for other columns, missing or
/// unreadable or infinite numbers, NaN, and a table without rows; FileError for a file that cannot be read.
Table read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

}  // namespace tamp::tools
