#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

/// Reads a text file: lines starting with # are comments, the first other line names the columns with their units, such
/// as `pressure[Pa]`, and each further line has one number a column, separated by commas. The columns are just those
/// asked for, in any order. Throws InputError, all problems with file and line at once, for other columns, missing or
/// unreadable or infinite numbers, NaN, and a table without rows; FileError for a file that cannot be read.
Table read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// As above, with the columns of one of several headings; also the number of that heading.
std::pair<Table, std::size_t> read_csv_table(const std::filesystem::path& file,
                                             const std::vector<std::vector<std::string>>& headings);

/// Each column of such a file by its name, whatever its columns are, with NaN for what is no number. Throws InputError
/// for a row that is shorter or longer than the first; FileError for a file that cannot be read.
std::vector<std::pair<std::string, std::vector<double>>> numbers_by_column(const std::filesystem::path& file);

/// Each column of such a file by its name, with the largest of its numbers; what is no number is passed over, and what
/// a row has too many or too few of, as any text may be looked at.
std::vector<std::pair<std::string, double>> greatest_of_columns(const std::filesystem::path& file);

}  // namespace tamp::tools
