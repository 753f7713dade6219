#include <fmt/core.h>

#include "tools/scene/json/keys.hpp"
#include "tools/scene/keys/schema.hpp"

namespace tamp::tools
{

namespace
{

std::string default_text(const Key& key)
{
  const auto& [value, words, is_compulsory] = key.default_value;
  if (!words.empty() || value.is_null()) return words;
  if (value.is_string()) return fmt::format("`\"{}\"`", value.get<std::string>());
  if (!value.is_number()) return value.is_boolean() ? value.dump() : "`" + value.dump() + "`";
  const auto number = value.get<double>();
  const bool is_list = std::holds_alternative<Numbers>(key.value) || std::holds_alternative<WholeNumbers>(key.value);
  if (is_list && number == 0) return "zeros";
  if (is_list && number == 1) return "ones";
  std::string text = fmt::format("{}", number);
  if (const std::size_t at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return is_list ? text + " each" : text;
}

std::string table_row(const std::vector<std::string>& cells)
{
  std::string text = "|";
  for (const std::string& cell : cells) text += cell.empty() ? " |" : " " + cell + " |";
  return text + "\n";
}

bool share_a_row(const Key& a, const Key& b)
{
  return !a.meaning.empty() && a.meaning == b.meaning && a.unit == b.unit && default_text(a) == default_text(b);
}

/// A row for each key, and for those of objects that have no table of their own.
std::string rows_of(const std::vector<Key>& keys, const std::string& prefix = "")
{
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Key& key = keys[i];
    std::string names = fmt::format("`{}{}`", prefix, key.name);
    for (; i + 1 < keys.size() && share_a_row(keys[i + 1], key); ++i) names += ", `" + keys[i + 1].name + "`";
    if (!key.meaning.empty()) text += table_row({names, shown_unit(key.unit), default_text(key), key.meaning});
    const auto* const object = std::get_if<Object>(&key.value);
    if (object != nullptr && object->keys().name.empty()) text += rows_of(object->keys().keys, prefix + key.name + "/");
  }
  return text;
}

std::string table_of(const std::vector<Key>& keys)
{
  return "| key | unit | default | meaning |\n| --- | --- | --- | --- |\n" + rows_of(keys);
}

/// A key with its meaning, unit and default, for a list within a line.
std::string key_summary(const Key& key)
{
  std::string text = "`" + key.name + "`";
  if (!key.meaning.empty()) text += ": " + key.meaning;
  if (!key.unit.empty()) text += " [" + shown_unit(key.unit) + "]";
  if (key.default_value.value.is_number() || key.default_value.value.is_boolean())
    text += " (" + default_text(key) + ")";
  return text;
}

/// A row for each type of an object in scenes of a dimension; 0: of any.
std::string table_of_types(const ObjectKeys& object, const std::string& meaning, int dimension)
{
  std::string text = "| `type` | other keys | " + meaning + " |\n| --- | --- | --- |\n";
  for (const TypeKeys& type : object.types) {
    if (type.only_in != dimension) continue;
    std::string keys;
    for (const Key& key : type.keys) keys += (keys.empty() ? "" : ", ") + key_summary(key);
    text += table_row({"`\"" + type.word + "\"`", keys, type.meaning});
  }
  return text;
}

}  // namespace

std::vector<std::string> key_tables()
{
  std::vector<std::string> tables;
  for (const KeysOf keys : {scene_keys, centrifuge_keys, contact_keys, body_keys, pressure_keys, drive_keys}) {
    tables.push_back(table_of(keys().keys));
  }
  tables.push_back(table_of_types(problem_keys(), "the body", 0));
  for (const int dimension : {0, 2, 3}) tables.push_back(table_of_types(solid_keys(), "region", dimension));
  tables.push_back(table_of(material_keys().keys));
  for (const TypeKeys& type : material_keys().types) tables.push_back(table_of(type.keys));
  return tables;
}

}  // namespace tamp::tools
