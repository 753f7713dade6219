#include "tools/scene/json_reader.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "runtime/graph/near_name.hpp"
#include "tools/scene/parse_json.hpp"

namespace tamp::tools
{

namespace
{

/// A value as a message shows it: short.
std::string shown(const Json& value)
{
  if (value.is_object()) return "an object";
  const std::string text = value.dump();
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

std::string joined(const std::vector<std::string>& words)
{
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string number_words(Range range, const std::string& unit)
{
  std::string words = "expected a number";
  if (!range.words().empty()) words += " " + range.words();
  if (!unit.empty()) words += " [" + unit + "]";
  return words;
}

bool is_plain_name(const std::string& name)
{
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_plain);
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& names)
{
  const std::string near = runtime::near_name(name, names);
  return near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near);
}

}  // namespace

JsonReader::JsonReader(Document& document, JsonPointer pointer) : document_(&document), pointer_(std::move(pointer)) {}

JsonReader JsonReader::nothing(Document& document)
{
  JsonReader reader(document);
  reader.exists_ = false;
  return reader;
}

void JsonReader::add_problem(const std::string& key, const std::string& found, const std::string& expected) const
{
  if (exists_) document_->add_problem(pointer_ / key, found, expected);
}

bool JsonReader::has(const std::string& key) const
{
  if (!exists_) return false;
  const Json& here = document_->root.at(pointer_);
  return here.contains(key) && !here.at(key).is_null();
}

const Json* JsonReader::find(const std::string& key)
{
  known_.push_back(key);
  return has(key) ? &document_->root.at(pointer_).at(key) : nullptr;
}

const Json* JsonReader::require(const std::string& key, const std::string& expected)
{
  const Json* value = find(key);
  if (value == nullptr) add_problem(key, "missing", expected);
  return value;
}

void JsonReader::write(const std::string& key, Json value)
{
  if (exists_) document_->root.at(pointer_)[key] = std::move(value);
}

double JsonReader::number(const std::string& key, Range range, const std::string& unit)
{
  const std::string expected = number_words(range, unit);
  const Json* value = require(key, expected);
  if (value == nullptr) return std::max(1.0, std::isfinite(range.lower) ? range.lower : 1.0);
  if (value->is_number() && range.contains(value->get<double>())) return value->get<double>();
  add_problem(key, shown(*value), expected);
  return 1;
}

double JsonReader::number(const std::string& key, Range range, double default_value)
{
  if (!has(key)) write(key, default_value);
  return number(key, range);
}

std::optional<double> JsonReader::optional_number(const std::string& key, Range range)
{
  if (find(key) == nullptr) {
    write(key, nullptr);
    return std::nullopt;
  }
  return number(key, range);
}

int JsonReader::integer(const std::string& key, int least, int most)
{
  const std::string expected = fmt::format("expected a whole number from {} to {}", least, most);
  const Json* value = require(key, expected);
  if (value == nullptr) return least;
  if (value->is_number_integer()) {
    const auto number = value->get<std::int64_t>();
    if (number >= least && number <= most) return static_cast<int>(number);
  }
  add_problem(key, shown(*value), expected);
  return least;
}

int JsonReader::integer(const std::string& key, int least, int most, int default_value)
{
  if (!has(key)) write(key, default_value);
  return integer(key, least, most);
}

template <class T>
std::vector<T> JsonReader::list(const std::string& key, std::size_t n, const std::string& expected,
                                bool (*fits)(const Json&), bool compulsory)
{
  const Json* value = compulsory ? require(key, expected) : find(key);
  if (value == nullptr) return {};
  if (!value->is_array() || value->size() != n || !std::all_of(value->begin(), value->end(), fits)) {
    add_problem(key, shown(*value), expected);
    return {};
  }
  return value->get<std::vector<T>>();
}

std::vector<double> JsonReader::numbers(const std::string& key, std::size_t n, Range range)
{
  std::string expected = fmt::format("expected {} numbers", n);
  if (!range.words().empty()) expected += ", each " + range.words();
  std::vector<double> values = list<double>(
      key, n, expected, [](const Json& v) { return v.is_number(); }, true);
  if (values.empty()) return std::vector<double>(n, 1);
  if (!std::all_of(values.begin(), values.end(), [&](double x) { return range.contains(x); })) {
    add_problem(key, shown(*find(key)), expected);
  }
  return values;
}

std::vector<double> JsonReader::numbers(const std::string& key, std::size_t n, Range range, double default_value)
{
  if (!has(key)) write(key, std::vector<double>(n, default_value));
  return numbers(key, n, range);
}

std::vector<std::vector<double>> JsonReader::rows(const std::string& key, std::size_t n)
{
  const std::string expected = fmt::format("expected a list of lists of {} numbers", n);
  const Json* value = require(key, expected);
  const auto is_row = [n](const Json& row) {
    return row.is_array() && row.size() == n &&
           std::all_of(row.begin(), row.end(), [](const Json& v) { return v.is_number(); });
  };
  if (value == nullptr) return {};
  if (value->is_array() && std::all_of(value->begin(), value->end(), is_row)) {
    return value->get<std::vector<std::vector<double>>>();
  }
  add_problem(key, shown(*value), expected);
  return {};
}

std::vector<int> JsonReader::integers(const std::string& key, std::size_t n, int least, int default_value)
{
  if (!has(key)) write(key, std::vector<int>(n, default_value));
  constexpr int most = 1'000'000;
  const std::string expected = fmt::format("expected {} whole numbers from {} to {}", n, least, most);
  const auto is_integer = [](const Json& v) { return v.is_number_integer(); };
  const std::vector<std::int64_t> values = list<std::int64_t>(key, n, expected, is_integer, true);
  const auto fits = [&](std::int64_t i) { return i >= least && i <= most; };
  if (values.empty() || !std::all_of(values.begin(), values.end(), fits)) {
    if (!values.empty()) add_problem(key, shown(*find(key)), expected);
    return std::vector<int>(n, least);
  }
  return {values.begin(), values.end()};
}

std::string JsonReader::text(const std::string& key, const std::string& default_value)
{
  const Json* value = find(key);
  if (value == nullptr) {
    write(key, default_value);
    return default_value;
  }
  if (value->is_string()) return value->get<std::string>();
  add_problem(key, shown(*value), "expected a text");
  return default_value;
}

bool JsonReader::is_object(const std::string& key)
{
  const Json* value = find(key);
  return value != nullptr && value->is_object();
}

bool JsonReader::is_text(const std::string& key, const std::string& word)
{
  const Json* value = find(key);
  return value != nullptr && *value == word;
}

bool JsonReader::flag(const std::string& key, bool default_value)
{
  if (!has(key)) write(key, default_value);
  const std::string expected = "expected true or false";
  const Json* value = require(key, expected);
  if (value == nullptr) return default_value;
  if (value->is_boolean()) return value->get<bool>();
  add_problem(key, shown(*value), expected);
  return default_value;
}

std::string JsonReader::choice(const std::string& key, const std::vector<std::string>& choices, bool has_default)
{
  const std::string expected = (choices.size() == 1 ? "expected " : "expected one of ") + joined(choices);
  if (has_default && !has(key)) write(key, choices.front());
  const Json* value = require(key, expected);
  if (value == nullptr) return {};
  if (value->is_string()) {
    const auto name = value->get<std::string>();
    if (std::find(choices.begin(), choices.end(), name) != choices.end()) return name;
    add_problem(key, shown(*value), expected + did_you_mean(name, choices));
  } else {
    add_problem(key, shown(*value), expected);
  }
  return {};
}

std::filesystem::path JsonReader::existing_file(const std::string& key)
{
  const std::string expected = "expected the path of a file";
  const Json* value = require(key, expected);
  if (value == nullptr) return {};
  if (!value->is_string()) {
    add_problem(key, shown(*value), expected);
    return {};
  }
  const std::filesystem::path file = path(key, value->get<std::string>());
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    add_problem(key, fmt::format("there is no file {}", file.string()), expected);
    return {};
  }
  const auto read = noting_problems(*document_, [&] {
    document_->add_input(file, (pointer_ / key).to_string());
    return true;
  });
  if (!read) return {};
  write_path(key, file);
  return file;
}

void JsonReader::allow_file(const std::string& key)
{
  const Json* value = find(key);
  if (value == nullptr || !value->is_string()) return;
  const std::filesystem::path file = path(key, value->get<std::string>());
  document_->add_unread(file, (pointer_ / key).to_string());
  write_path(key, file);
}

std::filesystem::path JsonReader::path(const std::string& key, const std::string& text) const
{
  return (document_->folder(pointer_ / key) / text).lexically_normal();
}

void JsonReader::write_path(const std::string& key, const std::filesystem::path& path)
{
  write(key, utf8(std::filesystem::absolute(path).lexically_normal().string()));
}

JsonReader JsonReader::object(const std::string& key)
{
  const Json* value = require(key, "expected an object");
  if (value == nullptr) return nothing(*document_);
  if (value->is_object()) return JsonReader(*document_, pointer_ / key);
  add_problem(key, shown(*value), "expected an object");
  return nothing(*document_);
}

std::optional<JsonReader> JsonReader::optional_object(const std::string& key)
{
  if (find(key) != nullptr) return object(key);
  write(key, nullptr);
  return std::nullopt;
}

JsonReader JsonReader::object_or_empty(const std::string& key)
{
  if (!has(key)) write(key, Json::object());
  return object(key);
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members(const std::string& key)
{
  JsonReader holder = object(key);
  std::vector<std::pair<std::string, JsonReader>> readers;
  if (!holder.exists_) return readers;
  const std::vector<std::string> all = names(key);
  if (all.empty()) add_problem(key, "an empty object", "expected at least one entry");
  for (const std::string& name : all) {
    if (!is_plain_name(name)) {
      document_->add_problem(holder.pointer_ / name, "a name with other characters",
                             "expected letters, digits, - and _ only: names become columns and groups of files");
    }
    readers.emplace_back(name, holder.object(name));
  }
  return readers;
}

std::vector<std::string> JsonReader::names(const std::string& key) const
{
  std::vector<std::string> all;
  if (!has(key)) return all;
  const Json& value = document_->root.at(pointer_).at(key);
  if (!value.is_object()) return all;
  for (const auto& [name, entry] : value.items()) all.push_back(name);
  return all;
}

std::vector<JsonReader> JsonReader::items(const std::string& key)
{
  if (!has(key)) write(key, Json::array());
  const Json* value = find(key);
  std::vector<JsonReader> readers;
  if (value == nullptr) return readers;
  if (!value->is_array()) {
    add_problem(key, shown(*value), "expected a list");
    return readers;
  }
  for (std::size_t i = 0; i < value->size(); ++i) {
    const JsonPointer item = pointer_ / key / i;
    if (value->at(i).is_object()) {
      readers.emplace_back(*document_, item);
    } else {
      document_->add_problem(item, shown(value->at(i)), "expected an object");
    }
  }
  return readers;
}

std::vector<std::string> JsonReader::choices(const std::string& key, std::size_t n,
                                             const std::vector<std::string>& choices)
{
  const std::string expected = fmt::format("expected {} of {}", n, joined(choices));
  const auto is_text = [](const Json& v) { return v.is_string(); };
  const std::vector<std::string> names = list<std::string>(key, n, expected, is_text, true);
  for (const std::string& name : names) {
    if (std::find(choices.begin(), choices.end(), name) != choices.end()) continue;
    add_problem(key, fmt::format("\"{}\"", name), expected + did_you_mean(name, choices));
    return {};
  }
  return names;
}

std::vector<std::string> JsonReader::some_of(const std::string& key, const std::vector<std::string>& choices)
{
  if (!has(key)) write(key, choices);
  const std::string expected = "expected a list of some of " + joined(choices);
  const Json* value = find(key);
  if (value == nullptr) return {};
  if (!value->is_array() || !std::all_of(value->begin(), value->end(), [](const Json& v) { return v.is_string(); })) {
    add_problem(key, shown(*value), expected);
    return {};
  }
  const auto names = value->get<std::vector<std::string>>();
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(choices.begin(), choices.end(), *name) == choices.end()) {
      add_problem(key, fmt::format("\"{}\"", *name), expected + did_you_mean(*name, choices));
    } else if (std::find(names.begin(), name, *name) != name) {
      add_problem(key, fmt::format("\"{}\" twice", *name), expected);
    }
  }
  return names;
}

void JsonReader::finish() const
{
  if (!exists_) return;
  for (const auto& [key, value] : document_->root.at(pointer_).items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::vector<std::string> names = known_;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const std::string near = did_you_mean(key, names);
    add_problem(key, "unknown key", near.empty() ? "expected one of " + joined(names) : near.substr(2));
  }
}

}  // namespace tamp::tools
