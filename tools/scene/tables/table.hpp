#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "components/errors.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

/// Columns of numbers from a file, and where in it each row stands.
struct Table {
  std::filesystem::path file;
  /// columns[i] holds the column that was asked for as number i.
  std::vector<std::vector<double>> columns;
  /// FILE:LINE, or FILE#/json/pointer.
  std::vector<std::string> place_of_row;

  std::size_t n_rows() const { return place_of_row.size(); }

  /// A problem of a row, with its place; with the file's name where there is no such row.
  Problem problem(std::ptrdiff_t row, const std::string& found, const std::string& expected) const;
};

/// Reads a table that has just the columns asked for, such as `pressure[Pa]`, from a file of either format, see
/// csv_table.hpp and published_table.hpp. Throws InputError and FileError as they do.
Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// The result of `make` for a table; its BadValue becomes an InputError at the row's place.
template <class Make>
auto made_from(Table& table, Make make)
{
  try {
    return make(table);
  } catch (const components::BadValue& bad) {
    throw InputError(table.problem(bad.row, bad.found, "expected " + bad.expected));
  }
}

}  // namespace tamp::tools
