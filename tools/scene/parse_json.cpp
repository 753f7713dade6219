#include "tools/scene/parse_json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "runtime/storage/file_error.hpp"

namespace tamp::tools
{

namespace
{

/// Follows a parser to know where it is, and notes keys that come twice.
class KeyWatch
{
 public:
  void operator()(Json::parse_event_t event, const Json& parsed)
  {
    using Event = Json::parse_event_t;
    switch (event) {
      case Event::object_start:
      case Event::array_start:
        enter_value();
        levels_.push_back({event == Event::array_start, 0, {}, {}});
        break;
      case Event::key:
        levels_.back().key = parsed.get<std::string>();
        if (!levels_.back().keys.insert(levels_.back().key).second) repeated.push_back(here());
        break;
      case Event::object_end:
      case Event::array_end:
        levels_.pop_back();
        break;
      case Event::value:
        enter_value();
        break;
    }
  }

  std::vector<JsonPointer> repeated;

 private:
  struct Level {
    bool array;
    std::size_t n_items;
    std::string key;
    std::set<std::string> keys;
  };

  void enter_value()
  {
    if (!levels_.empty()) ++levels_.back().n_items;
  }

  JsonPointer here() const
  {
    JsonPointer pointer;
    for (const Level& level : levels_) {
      if (level.array) {
        pointer /= level.n_items - 1;
      } else {
        pointer /= level.key;
      }
    }
    return pointer;
  }

  std::vector<Level> levels_;
};

/// The parser's message without its own name and number: "... syntax error while parsing value - ...".
std::string cause_of(const Json::exception& error)
{
  const std::string text = error.what();
  const std::size_t bracket = text.find("] ");
  return bracket == std::string::npos ? text : text.substr(bracket + 2);
}

Problem not_json(const std::filesystem::path& file, const std::string& text, std::size_t byte, const std::string& cause)
{
  const std::string before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n');
  const std::size_t column = before.size() - (line_start == std::string::npos ? 0 : line_start + 1) + 1;
  return {fmt::format("{}:{}:{}", file.string(), line, column), cause, "expected JSON"};
}

std::string whole_text(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    const bool exists = std::filesystem::exists(file);
    throw runtime::FileError(file.string(), exists ? "cannot be read" : "no such file");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

Json parse_json(const std::filesystem::path& file)
{
  const std::string text = whole_text(file);
  KeyWatch watch;
  Json value;
  try {
    value = Json::parse(text, [&watch](int, Json::parse_event_t event, Json& parsed) {
      watch(event, parsed);
      return true;
    });
  } catch (const Json::parse_error& error) {
    throw InputError(not_json(file, text, error.byte, cause_of(error)));
  } catch (const Json::exception& error) {  // a number too large to be one
    throw InputError({file.string(), cause_of(error), "expected JSON with numbers that a double can hold"});
  }
  if (!watch.repeated.empty()) {
    std::vector<Problem> problems;
    for (const JsonPointer& pointer : watch.repeated) {
      problems.push_back({file.string() + "#" + pointer.to_string(), "the key is given twice", "expected it once"});
    }
    throw InputError(std::move(problems));
  }
  return value;
}

}  // namespace tamp::tools
