#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/errors.hpp"

namespace tamp::tools
{

/// A table of numbers from a file: lines starting with # are comments, the first other line names the columns with
/// their units, such as `pressure[Pa]`, and each further line has one number a column, separated by commas.
struct CsvTable {
  std::filesystem::path file;
  /// columns[i] holds the column that was asked for as number i.
  std::vector<std::vector<double>> columns;
  /// The line in the file, counted from 1, of each row.
  std::vector<int> line_of_row;

  std::size_t n_rows() const { return line_of_row.size(); }

  /// What is wrong with a row, said with the file and its line.
  Problem problem(std::ptrdiff_t row, const std::string& found, const std::string& expected) const;
};

/// Reads a table that has just the columns asked for, in any order. Throws InputError, all problems with file and line
/// at once, for other columns, missing or unreadable or infinite numbers, NaN, and a table without rows; FileError for
/// a file that cannot be read.
CsvTable read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

}  // namespace tamp::tools
