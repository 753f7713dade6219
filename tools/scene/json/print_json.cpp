#include "tools/scene/json/print_json.hpp"

#include <algorithm>

namespace tamp::tools
{

namespace
{

constexpr std::size_t line_length = 100;

bool is_flat(const Json& value)
{
  return std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); });
}

/// The value on one line, its parts separated by blanks.
std::string on_one_line(const Json& value)
{
  if (!value.is_structured()) return json_text(value);
  std::string text;
  for (const auto& [key, member] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += json_text(key) + ": ";
    text += on_one_line(member);
  }
  if (value.is_array()) return "[" + text + "]";
  return text.empty() ? "{}" : "{ " + text + " }";
}

void print(const Json& value, std::size_t indent, std::string& out)
{
  if (!value.is_structured() || is_flat(value)) {
    const std::string line = on_one_line(value);
    if (!value.is_structured() || value.empty() || indent + line.size() <= line_length) {
      out += line;
      return;
    }
  }
  const std::string blanks(indent + 2, ' ');
  out += value.is_array() ? '[' : '{';
  bool first = true;
  for (const auto& [key, member] : value.items()) {
    out += first ? "\n" : ",\n";
    first = false;
    out += blanks;
    if (value.is_object()) out += json_text(key) + ": ";
    print(member, indent + 2, out);
  }
  out += '\n' + std::string(indent, ' ') + (value.is_array() ? ']' : '}');
}

}  // namespace

std::string printed(const Json& value)
{
  std::string out;
  print(value, 0, out);
  return out;
}

std::string json_text(const Json& value, int indent)
{
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tamp::tools
