#include "tools/study/reading/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/scene/json/parse_json.hpp"
#include "tools/study/points.hpp"

namespace tamp::tools::study
{

std::string StudyReader::pointer(JsonReader& reader, const std::string& key)
{
  const std::string text = reader.text(key, "");
  if (!text.empty() && !is_pointer(text)) {
    reader.add_problem(key, fmt::format("\"{}\"", text), "expected a JSON pointer, such as /grid/cell_size");
    return {};
  }
  return text;
}

std::string StudyReader::needed_text(JsonReader& reader, const std::string& key)
{
  std::string text = reader.text(key, "");
  if (text.empty()) reader.add_problem(key, "missing", "expected a text");
  return text;
}

std::vector<std::string> StudyReader::names(JsonReader& reader, const std::string& key)
{
  std::vector<std::string> names;
  for (const Json& name : list(reader, key)) {
    if (name.is_string()) {
      names.push_back(name);
    } else {
      reader.add_problem(key, name.dump(), "expected a list of texts");
    }
  }
  return names;
}

std::vector<Json> StudyReader::list(JsonReader& reader, const std::string& key)
{
  if (!reader.has(key)) return {};
  const Json& value = document.root.at(reader.pointer(key));
  if (value.is_array()) return {value.begin(), value.end()};
  reader.add_problem(key, value.type_name(), "expected a list");
  return {};
}

Settings StudyReader::settings(JsonReader& reader, const std::string& key)
{
  if (!reader.has(key)) return {};
  return settings_of(document.root.at(reader.pointer(key)), reader, key);
}

Settings StudyReader::settings_of(const Json& object, JsonReader& reader, const std::string& key)
{
  if (!object.is_object()) {
    reader.add_problem(key, object.type_name(), "expected an object: JSON pointer → value");
    return {};
  }
  Settings settings;
  for (const auto& [text, value] : object.items()) {
    if (!is_pointer(text)) {
      reader.add_problem(key, fmt::format("\"{}\"", text), "expected a JSON pointer, such as /grid/cell_size");
    } else {
      settings.emplace_back(text, with_file_from_here(value));
    }
  }
  return settings;
}

std::vector<Axis> StudyReader::axes(JsonReader& reader, const std::string& key)
{
  std::vector<Axis> axes;
  for (const auto& [text, value] : settings(reader, key)) {
    if (!value.is_array() || value.empty()) {
      reader.add_problem(key, fmt::format("{} at {}", value.dump(), text), "expected a list of values");
      continue;
    }
    Axis axis{text, {}};
    for (const Json& one : value) axis.values.push_back(with_file_from_here(one));
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::filesystem::path StudyReader::from_here(const std::filesystem::path& file)
{
  return file.empty() ? file : std::filesystem::proximate(file);
}

Json StudyReader::with_file_from_here(const Json& value) const
{
  if (!value.is_string()) return value;
  const std::filesystem::path file = document.file().parent_path() / value.get<std::string>();
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return value;
  const std::string path = from_here(file).string();
  if (utf8(path) == path) return path;
  throw InputError({document.file().string(), "a setting that names " + path, "expected a path that is UTF-8"});
}

Method* StudyReader::find_method(const std::string& name)
{
  const auto at = std::find_if(study.methods.begin(), study.methods.end(),
                               [&](const Method& method) { return method.name == name; });
  return at == study.methods.end() ? nullptr : &*at;
}

bool StudyReader::find_quantity(const std::string& name) const
{
  return std::any_of(study.quantities.begin(), study.quantities.end(),
                     [&](const Quantity& quantity) { return quantity.name == name; });
}

bool StudyReader::has_exact_answer(const std::string& name) const
{
  return std::any_of(study.quantities.begin(), study.quantities.end(),
                     [&](const Quantity& quantity) { return quantity.name == name && quantity.exact; });
}

bool StudyReader::has_error(const std::string& name) const
{
  return has_exact_answer(name) || (find_quantity(name) && study.reference);
}

}  // namespace tamp::tools::study
