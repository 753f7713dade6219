#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// A value as a cell of a CSV table: text in quotes where it has commas, quotes or line breaks, and nothing for null.
/// Text that a spreadsheet would run as a formula, as it begins with =, +, -, @, a tab or a carriage return, begins
/// with an apostrophe instead.
std::string csv_cell(const Json& value);

/// The cells of a row with the names of their columns.
using CsvRow = std::vector<std::pair<std::string, Json>>;

CsvRow csv_row(const Json& object);

/// A line with the names of the columns, and a line for each row; all rows have the same. Empty without rows.
std::string csv_text(const std::vector<CsvRow>& rows);

}  // namespace tamp::tools
