#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tamp::tools
{

/// A value as a cell of a CSV table: text in quotes where it has commas, quotes or line breaks, and nothing for null.
/// Text that a spreadsheet would run as a formula, as it begins with =, +, -, @, a tab or a carriage return, begins
/// with an apostrophe instead.
std::string csv_cell(const nlohmann::ordered_json& value);

}  // namespace tamp::tools
