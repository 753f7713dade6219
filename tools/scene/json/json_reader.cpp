#include "tools/scene/json/json_reader.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "runtime/graph/near_name.hpp"
#include "tools/scene/json/parse_json.hpp"

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

constexpr double largest_factor = 1e50;

bool is_too_large(const Json& value)
{
  if (value.is_array()) return std::any_of(value.begin(), value.end(), is_too_large);
  return value.is_number() && std::abs(value.get<double>()) > largest_factor;
}

std::string joined(const std::vector<std::string>& words)
{
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string expected_number(const Number& number, const std::string& unit)
{
  std::string words = "expected a number";
  if (!number.range.words().empty()) words += " " + number.range.words();
  if (!unit.empty()) words += " [" + unit + "]";
  if (!number.word.empty()) words += ", or " + number.word;
  return words;
}

bool is_number(const Json& value)
{
  return value.is_number();
}

bool is_whole_number(const Json& value)
{
  return value.is_number_integer();
}

bool is_text(const Json& value)
{
  return value.is_string();
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

JsonReader::JsonReader(Document& document, const ObjectKeys& keys, JsonPointer pointer)
    : document_(&document), pointer_(std::move(pointer)), object_(&keys)
{
}

std::vector<const std::vector<Key>*> JsonReader::declared() const
{
  if (type_ == nullptr) return {&object_->keys};
  return {&object_->keys, &type_->keys};
}

const Key& JsonReader::declared(const std::string& key) const
{
  for (const std::vector<Key>* keys : declared()) {
    const auto at = std::find_if(keys->begin(), keys->end(), [&](const Key& k) { return k.name == key; });
    if (at != keys->end()) return *at;
  }
  throw std::logic_error(fmt::format("{}: a key that is not declared", (pointer_ / key).to_string()));
}

bool JsonReader::is_in_scene(int only_in) const
{
  return only_in == 0 || only_in == document_->dimension;
}

std::size_t JsonReader::count(Length length) const
{
  return static_cast<std::size_t>(document_->dimension == 3 ? length.in_space : length.in_plane);
}

void JsonReader::expect_numbers_to_multiply() const
{
  if (!exists_) return;
  for (const auto& [key, value] : document_->root.at(pointer_).items()) {
    if (is_too_large(value)) {
      add_problem(
          key, shown(value),
          fmt::format("expected {} of at most {:g}", value.is_array() ? "numbers" : "a number", largest_factor));
    }
  }
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

const Json* JsonReader::find(const std::string& key) const
{
  return has(key) ? &document_->root.at(pointer_).at(key) : nullptr;
}

const Json* JsonReader::require(const std::string& key, const std::string& expected) const
{
  const Json* value = find(key);
  if (value == nullptr) add_problem(key, "missing", expected);
  return value;
}

void JsonReader::write(const std::string& key, Json value)
{
  if (exists_) document_->root.at(pointer_)[key] = std::move(value);
}

void JsonReader::fill_in(const std::string& key, Json value)
{
  if (exists_) document_->left_out.push_back(pointer(key).to_string());
  write(key, std::move(value));
}

void JsonReader::write_default(const std::string& key, std::size_t n_entries)
{
  const Json& value = declared(key).default_value.value;
  if (has(key) || value.is_null()) return;
  fill_in(key, n_entries == 0 ? value : Json(std::vector<Json>(n_entries, value)));
}

double JsonReader::number(const std::string& key)
{
  const auto& number = declared_as<Number>(key);
  const std::string expected = expected_number(number, declared(key).unit);
  write_default(key);
  const Json* value = require(key, expected);
  if (value == nullptr) return std::max(1.0, std::isfinite(number.range.lower) ? number.range.lower : 1.0);
  if (value->is_number() && number.range.contains(value->get<double>())) return value->get<double>();
  add_problem(key, shown(*value), expected);
  return 1;
}

double JsonReader::number(const std::string& key, double default_value)
{
  if (!has(key)) fill_in(key, default_value);
  return number(key);
}

std::optional<double> JsonReader::optional_number(const std::string& key)
{
  if (has(key)) return number(key);
  fill_in(key, nullptr);
  return std::nullopt;
}

int JsonReader::whole_number(const std::string& key)
{
  const auto [least, most] = declared_as<WholeNumber>(key);
  const std::string expected = fmt::format("expected a whole number from {} to {}", least, most);
  write_default(key);
  const Json* value = require(key, expected);
  if (value == nullptr) return least;
  if (value->is_number_integer()) {
    const auto number = value->get<std::int64_t>();
    if (number >= least && number <= most) return static_cast<int>(number);
  }
  add_problem(key, shown(*value), expected);
  return least;
}

template <class T>
std::vector<T> JsonReader::list(const std::string& key, std::size_t n, const std::string& expected,
                                bool (*fits)(const Json&))
{
  write_default(key, n);
  const Json* value = require(key, expected);
  if (value == nullptr) return {};
  if (value->is_array() && value->size() == n && std::all_of(value->begin(), value->end(), fits)) {
    return value->get<std::vector<T>>();
  }
  add_problem(key, shown(*value), expected);
  return {};
}

std::vector<double> JsonReader::numbers(const std::string& key)
{
  const auto& [length, range] = declared_as<Numbers>(key);
  std::string expected = fmt::format("expected {} numbers", count(length));
  if (!range.words().empty()) expected += ", each " + range.words();
  std::vector<double> values = list<double>(key, count(length), expected, is_number);
  if (values.empty()) return std::vector<double>(count(length), 1);
  if (!std::all_of(values.begin(), values.end(), [&r = range](double x) { return r.contains(x); })) {
    add_problem(key, shown(*find(key)), expected);
  }
  return values;
}

std::optional<std::vector<double>> JsonReader::optional_numbers(const std::string& key)
{
  if (!has(key)) return std::nullopt;
  return numbers(key);
}

std::vector<int> JsonReader::whole_numbers(const std::string& key)
{
  const auto& allowed = declared_as<WholeNumbers>(key);
  const std::size_t n = count(allowed.length);
  const std::string expected = fmt::format("expected {} whole numbers from {} to {}", n, allowed.least, allowed.most);
  const auto values = list<std::int64_t>(key, n, expected, is_whole_number);
  const auto fits = [&](std::int64_t i) { return i >= allowed.least && i <= allowed.most; };
  if (values.empty() || !std::all_of(values.begin(), values.end(), fits)) {
    if (!values.empty()) add_problem(key, shown(*find(key)), expected);
    return std::vector<int>(n, allowed.least);
  }
  return {values.begin(), values.end()};
}

std::vector<std::vector<double>> JsonReader::rows(const std::string& key)
{
  const std::size_t n = count(declared_as<Rows>(key).length);
  const std::string expected = fmt::format("expected a list of lists of {} numbers", n);
  const Json* value = require(key, expected);
  const auto is_row = [n](const Json& row) {
    return row.is_array() && row.size() == n && std::all_of(row.begin(), row.end(), is_number);
  };
  if (value == nullptr) return {};
  if (value->is_array() && std::all_of(value->begin(), value->end(), is_row)) {
    return value->get<std::vector<std::vector<double>>>();
  }
  add_problem(key, shown(*value), expected);
  return {};
}

bool JsonReader::flag(const std::string& key)
{
  write_default(key);
  const bool default_value = declared(key).default_value.value.get<bool>();
  const Json* value = find(key);
  if (value == nullptr) return default_value;
  if (value->is_boolean()) return value->get<bool>();
  add_problem(key, shown(*value), "expected true or false");
  return default_value;
}

std::string JsonReader::text(const std::string& key, const std::string& default_value)
{
  if (!has(key)) fill_in(key, default_value);
  const Json* value = find(key);
  if (value == nullptr || value->is_string()) return value == nullptr ? default_value : value->get<std::string>();
  add_problem(key, shown(*value), "expected a text");
  return default_value;
}

bool JsonReader::has_word(const std::string& key) const
{
  const Json* value = find(key);
  return value != nullptr && *value == declared_as<Number>(key).word;
}

bool JsonReader::is_object(const std::string& key) const
{
  const Json* value = find(key);
  return value != nullptr && value->is_object();
}

std::string JsonReader::one_of(const std::string& key, const std::vector<std::string>& words,
                               const std::string& also) const
{
  const std::string expected =
      (words.size() == 1 ? "expected " : "expected one of ") + joined(words) + (also.empty() ? "" : ", " + also);
  const Json* value = require(key, expected);
  if (value == nullptr) return {};
  if (value->is_string()) {
    const auto word = value->get<std::string>();
    if (std::find(words.begin(), words.end(), word) != words.end()) return word;
    add_problem(key, shown(*value), expected + did_you_mean(word, words));
  } else {
    add_problem(key, shown(*value), expected);
  }
  return {};
}

std::string JsonReader::word(const std::string& key)
{
  write_default(key);
  return one_of(key, declared_as<Choice>(key).words, shown_instead(key));
}

/// The objects that may stand at a key in place of a word or a name.
const std::vector<Instead>& JsonReader::instead(const std::string& key) const
{
  static const std::vector<Instead> nothing;
  const Value& value = declared(key).value;
  if (const auto* choice = std::get_if<Choice>(&value)) return choice->instead;
  if (const auto* name = std::get_if<Name>(&value)) return name->instead;
  return nothing;
}

std::string JsonReader::shown_instead(const std::string& key) const
{
  std::vector<std::string> shown;
  for (const Instead& object : instead(key)) shown.push_back(object.shown);
  return fmt::format("{}", fmt::join(shown, ", "));
}

const Instead& JsonReader::object_instead(const std::string& key) const
{
  const std::vector<std::string> members = members_of(key);
  const auto is_there = [&](const Key& own) { return std::ranges::find(members, own.name) != members.end(); };
  const std::vector<Instead>& objects = instead(key);
  const auto at = std::ranges::find_if(
      objects, [&](const Instead& object) { return std::ranges::any_of(object.keys().keys, is_there); });
  return at == objects.end() ? objects.front() : *at;
}

std::optional<int> JsonReader::value_of_object(const std::string& key) const
{
  if (instead(key).empty() || !is_object(key)) return std::nullopt;
  return object_instead(key).value;
}

int JsonReader::value_of_choice(const std::string& key)
{
  if (const auto value = value_of_object(key)) return *value;
  const auto& choice = declared_as<Choice>(key);
  const auto at = std::find(choice.words.begin(), choice.words.end(), word(key));
  return at == choice.words.end() ? choice.values.front()
                                  : choice.values.at(static_cast<std::size_t>(at - choice.words.begin()));
}

std::string JsonReader::type()
{
  std::vector<std::string> words;
  for (const TypeKeys& type : object_->types) {
    if (is_in_scene(type.only_in)) words.push_back(type.word);
  }
  const std::string word = one_of("type", words);
  for (const TypeKeys& type : object_->types) {
    if (type.word == word) type_ = &type;
  }
  return is_over_type_of_file(word) ? "" : word;
}

bool JsonReader::is_over_type_of_file(const std::string& type) const
{
  const auto* const overridden = exists_ ? document_->overridden_type(pointer_) : nullptr;
  if (overridden == nullptr || type_ == nullptr) return false;
  const auto has = [](const std::vector<Key>& keys, const std::string& name) {
    return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
  };
  const auto of_file = std::find_if(object_->types.begin(), object_->types.end(),
                                    [&](const TypeKeys& t) { return t.word == overridden->type; });
  if (of_file == object_->types.end()) return false;
  bool is_mixed = false;
  for (const auto& [name, value] : document_->root.at(pointer_).items()) {
    if (has(of_file->keys, name) && !has(type_->keys, name) && !has(object_->keys, name)) is_mixed = true;
  }
  if (!is_mixed) return false;
  add_problem(
      "type",
      fmt::format("\"{}\" over the \"{}\" of {}, whose keys it has not", type, overridden->type, overridden->file),
      fmt::format("expected the type of the file; --set '{}={{\"file\":\"{}\"}}' takes all of it", pointer_.to_string(),
                  overridden->file));
  return true;
}

std::string JsonReader::name(const std::string& key, const std::vector<std::string>& names)
{
  write_default(key);
  std::vector<std::string> words = declared_as<Name>(key).words;
  words.insert(words.end(), names.begin(), names.end());
  return one_of(key, words, shown_instead(key));
}

std::string JsonReader::name(const std::string& key, const std::vector<std::string>& names,
                             const std::string& default_value)
{
  if (!has(key)) fill_in(key, default_value);
  return name(key, names);
}

std::vector<std::string> JsonReader::names(const std::string& key, const std::vector<std::string>& names)
{
  const std::size_t n = count(declared_as<Names>(key).length);
  const std::string expected = fmt::format("expected {} of {}", n, joined(names));
  const auto found = list<std::string>(key, n, expected, is_text);
  for (const std::string& name : found) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    add_problem(key, fmt::format("\"{}\"", name), expected + did_you_mean(name, names));
    return {};
  }
  return found;
}

std::filesystem::path JsonReader::existing_file(const std::string& key)
{
  declared_as<File>(key);
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

void JsonReader::pass_over_file(const std::string& key)
{
  declared_as<File>(key);
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

JsonReader JsonReader::at(const std::string& key, const ObjectKeys& keys) const
{
  JsonReader reader(*document_, keys, pointer_ / key);
  const Json* value = require(key, "expected an object");
  reader.exists_ = value != nullptr && value->is_object();
  if (value != nullptr && !reader.exists_) add_problem(key, shown(*value), "expected an object");
  return reader;
}

JsonReader JsonReader::object(const std::string& key)
{
  write_default(key);
  const Value& value = declared(key).value;
  if (!instead(key).empty()) return at(key, object_instead(key).keys());
  if (const auto* members = std::get_if<Members>(&value)) return at(key, members->keys());
  return at(key, std::get<Object>(value).keys());
}

std::optional<JsonReader> JsonReader::optional_object(const std::string& key)
{
  if (has(key)) return object(key);
  fill_in(key, nullptr);
  return std::nullopt;
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members(const std::string& key)
{
  const ObjectKeys& keys = declared_as<Members>(key).keys();
  JsonReader holder = at(key, keys);
  std::vector<std::pair<std::string, JsonReader>> readers;
  if (!holder.exists_) return readers;
  const std::vector<std::string> all = members_of(key);
  if (all.empty()) add_problem(key, "an empty object", "expected at least one entry");
  for (const std::string& name : all) {
    if (!is_plain_name(name)) {
      document_->add_problem(holder.pointer_ / name, "a name with other characters",
                             "expected letters, digits, - and _ only: names become columns and groups of files");
    }
    readers.emplace_back(name, holder.at(name, keys));
  }
  return readers;
}

std::vector<std::string> JsonReader::members_of(const std::string& key) const
{
  std::vector<std::string> all;
  if (!is_object(key)) return all;
  for (const auto& [name, entry] : document_->root.at(pointer_).at(key).items()) all.push_back(name);
  return all;
}

std::vector<JsonReader> JsonReader::objects(const std::string& key)
{
  write_default(key);
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
      readers.emplace_back(*document_, declared_as<Objects>(key).keys(), item);
    } else {
      document_->add_problem(item, shown(value->at(i)), "expected an object");
    }
  }
  return readers;
}

std::vector<std::string> JsonReader::some_of(const std::string& key, const std::vector<std::string>& names)
{
  declared_as<SomeNames>(key);
  if (!has(key)) fill_in(key, names);
  const std::string expected = "expected a list of some of " + joined(names);
  const Json* value = find(key);
  if (value == nullptr) return {};
  if (!value->is_array() || !std::all_of(value->begin(), value->end(), is_text)) {
    add_problem(key, shown(*value), expected);
    return {};
  }
  const auto found = value->get<std::vector<std::string>>();
  for (auto name = found.begin(); name != found.end(); ++name) {
    if (std::find(names.begin(), names.end(), *name) == names.end()) {
      add_problem(key, fmt::format("\"{}\"", *name), expected + did_you_mean(*name, names));
    } else if (std::find(found.begin(), name, *name) != name) {
      add_problem(key, fmt::format("\"{}\" twice", *name), expected);
    }
  }
  return found;
}

void JsonReader::finish() const
{
  if (!exists_) return;
  std::vector<std::string> names;
  for (const std::vector<Key>* keys : declared()) {
    for (const Key& key : *keys) {
      if (is_in_scene(key.only_in)) names.push_back(key.name);
    }
  }
  if (!object_->types.empty()) names.emplace_back("type");
  std::sort(names.begin(), names.end());
  for (const auto& [key, value] : document_->root.at(pointer_).items()) {
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    if (object_->may_be_a_file && key == "$schema") continue;
    const std::string near = did_you_mean(key, names);
    add_problem(key, unknown_key, near.empty() ? "expected one of " + joined(names) : near.substr(2));
  }
}

}  // namespace tamp::tools
