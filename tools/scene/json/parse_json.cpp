#include "tools/scene/json/parse_json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "tools/scene/files/input_file.hpp"

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

struct TooDeep {
};

/// Throws TooDeep for too many levels, so that none is ever made.
Json parsed(const std::string& text, KeyWatch& watch, bool with_comments)
{
  const auto follow = [&watch](int depth, Json::parse_event_t event, Json& value) {
    if (depth > most_json_levels) throw TooDeep();
    watch(event, value);
    return true;
  };
  return Json::parse(text, follow, true, with_comments);
}

}  // namespace

Json parse_json(const std::filesystem::path& file)
{
  const std::string text = read_input_text(file);
  KeyWatch watch;
  Json value;
  try {
    value = parsed(text, watch, true);
  } catch (const TooDeep&) {
    throw InputError(
        {file.string(), fmt::format("more than {} levels of lists and objects", most_json_levels), "expected fewer"});
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

std::string utf8(const std::string& text)
{
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::optional<Json> json_of(const std::string& text)
{
  KeyWatch watch;
  try {
    return parsed(text, watch, false);
  } catch (const TooDeep&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace tamp::tools
