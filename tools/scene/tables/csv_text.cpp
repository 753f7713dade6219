#include "tools/scene/tables/csv_text.hpp"

#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

std::string csv_cell(const nlohmann::ordered_json& value)
{
  if (value.is_null()) return "";
  std::string text = value.is_string() ? utf8(value.get<std::string>()) : value.dump();
  if (value.is_string() && text.find_first_of("=+-@\t\r") == 0) text.insert(0, 1, '\'');
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return text.find_first_of(",\"\n\r") == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace tamp::tools
