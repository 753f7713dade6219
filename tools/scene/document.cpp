#include "tools/scene/document.hpp"

#include <fmt/core.h>

#include "tools/scene/parse_json.hpp"

namespace tamp::tools
{

namespace
{

constexpr const char* command_line = "--set";

/// Is `pointer` at or below `above`?
bool lies_below(const std::string& pointer, const std::string& above)
{
  return pointer.starts_with(above) && (pointer.size() == above.size() || pointer[above.size()] == '/');
}

Json parsed_or_text(const std::string& text)
{
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

}  // namespace

Document::Document(const std::filesystem::path& file) : root(parse_json(file)), file_(file)
{
  if (!root.is_object()) throw InputError({file.string() + "#", root.type_name(), "expected an object"});
}

void Document::set(const std::string& assignment)
{
  const std::string place = fmt::format("--set {}", assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || assignment[0] != '/') {
    throw InputError({place, "not an assignment", "expected /POINTER=VALUE, such as /grid/cell_size=0.01"});
  }
  const std::string pointer = assignment.substr(0, equals);
  try {
    root[JsonPointer(pointer)] = parsed_or_text(assignment.substr(equals + 1));
  } catch (const Json::exception&) {
    throw InputError({place, "there is no such place in the scene", "expected a pointer to a key or to an item"});
  }
  origins_.push_back({pointer, command_line, pointer});
}

void Document::merge_file_named_at(const JsonPointer& pointer)
{
  Json patch = root.at(pointer);
  if (!patch.is_object() || !patch.contains("file")) return;
  const JsonPointer here = pointer / "file";
  const Json name = patch["file"];
  if (!name.is_string()) {
    add_problem(here, name.dump(), "expected the path of a JSON file");
    return;
  }
  patch.erase("file");

  const std::filesystem::path path = (folder(here) / name.get<std::string>()).lexically_normal();
  if (!std::filesystem::is_regular_file(path)) {
    add_problem(here, fmt::format("there is no file {}", path.string()), "expected the path of a JSON file");
    return;
  }
  Json merged;
  try {
    merged = parse_json(path);
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems.begin(), error.problems.end());
    return;
  }
  if (!merged.is_object()) {
    add_problem(here, fmt::format("{} holds no object", path.string()), "expected the path of a JSON object");
    return;
  }

  // What --set put below here stays noted as such: these origins come before it.
  const std::vector<Origin> set = std::move(origins_);
  origins_.clear();
  for (const Origin& o : set) {
    if (!lies_below(o.pointer, pointer.to_string())) origins_.push_back(o);
  }
  origins_.push_back({pointer.to_string(), path.string(), ""});
  note_overrides(merged, patch, pointer);
  for (const Origin& o : set) {
    if (lies_below(o.pointer, pointer.to_string())) origins_.push_back(o);
  }
  merged.merge_patch(patch);
  root.at(pointer) = std::move(merged);
}

void Document::note_overrides(const Json& base, const Json& patch, const JsonPointer& pointer)
{
  for (const auto& [key, value] : patch.items()) {
    const JsonPointer here = pointer / key;
    if (value.is_object() && base.contains(key) && base[key].is_object()) {
      note_overrides(base[key], value, here);
    } else {
      origins_.push_back({here.to_string(), file_.string(), here.to_string()});
    }
  }
}

Document::Origin Document::origin(const std::string& pointer) const
{
  Origin found{"", file_.string(), ""};
  for (const Origin& o : origins_) {
    if (lies_below(pointer, o.pointer) && o.pointer.size() >= found.pointer.size()) found = o;
  }
  return found;
}

std::string Document::place(const JsonPointer& pointer) const
{
  const std::string text = pointer.to_string();
  const Origin from = origin(text);
  return fmt::format("{}#{}{}", from.file, from.pointer_there, text.substr(from.pointer.size()));
}

std::filesystem::path Document::folder(const JsonPointer& pointer) const
{
  const Origin from = origin(pointer.to_string());
  if (from.file == command_line) return ".";
  return std::filesystem::path(from.file).parent_path();
}

void Document::add_problem(const JsonPointer& pointer, std::string found, std::string expected)
{
  problems.push_back({place(pointer), std::move(found), std::move(expected)});
}

}  // namespace tamp::tools
