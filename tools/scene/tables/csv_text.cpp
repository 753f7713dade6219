#include "tools/scene/tables/csv_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

std::string csv_cell(const Json& value)
{
  if (value.is_null()) return "";
  std::string text = value.is_string() ? utf8(value.get<std::string>()) : value.dump();
  if (value.is_string() && text.find_first_of("=+-@\t\r") == 0) text.insert(0, 1, '\'');
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return text.find_first_of(",\"\n\r") == std::string::npos ? text : "\"" + text + "\"";
}

CsvRow csv_row(const Json& object)
{
  CsvRow row;
  for (const auto& [name, value] : object.items()) row.emplace_back(name, value);
  return row;
}

std::string csv_text(const std::vector<CsvRow>& rows)
{
  std::string text;
  for (const CsvRow& row : rows) {
    std::vector<std::string> names, cells;
    for (const auto& [name, value] : row) {
      names.push_back(csv_cell(name));
      cells.push_back(csv_cell(value));
    }
    if (text.empty()) text = fmt::format("{}\n", fmt::join(names, ","));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

}  // namespace tamp::tools
