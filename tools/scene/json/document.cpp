#include "tools/scene/json/document.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "tools/scene/json/old_words.hpp"
#include "tools/scene/json/parse_json.hpp"

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

/// Whether the pointer names a key, or an item that is there or would be the next.
bool can_be_set(const Json& root, const JsonPointer& pointer)
{
  if (pointer.empty()) return true;
  const JsonPointer above = pointer.parent_pointer();
  if (!can_be_set(root, above)) return false;
  const bool is_new = !root.contains(above) || root.at(above).is_null();
  if (!is_new && !root.at(above).is_array()) return true;
  std::size_t item = 0;
  const std::string& text = pointer.back();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), item);
  if (error != std::errc() || end != text.data() + text.size()) return is_new || text == "-";
  return item <= (is_new ? 0 : root.at(above).size());
}

/// As RFC 7386, but that a null stays: it may remove a key of a file that comes in later.
void lay_over(Json& base, const Json& patch)
{
  for (const auto& [key, value] : patch.items()) {
    if (value.is_object() && base.contains(key) && base[key].is_object()) {
      lay_over(base[key], value);
    } else {
      base[key] = value;
    }
  }
}

}  // namespace

Document::Document(const std::filesystem::path& file, const ObjectKeys& keys)
    : root(parse_json(file)), file_(file), keys_(&keys)
{
  if (!root.is_object()) throw InputError({file.string() + "#", root.type_name(), "expected an object"});
  add_input(file);
  origins_ = replace_old_words_in(root, keys, JsonPointer(), file.string());
}

void Document::set(const std::string& assignment)
{
  const std::string place = fmt::format("--set {}", assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || assignment[0] != '/') {
    throw InputError({place, "not an assignment", "expected /POINTER=VALUE, such as /grid/cell_size=0.01"});
  }
  const std::string pointer = assignment.substr(0, equals);
  const InputError no_place(
      {place, "there is no such place in the scene", "expected a pointer to a key or to an item"});
  const std::string value = assignment.substr(equals + 1);
  if (utf8(assignment) != assignment) throw InputError({"--set", "bytes that are no text", "expected UTF-8"});
  try {
    const JsonPointer at(pointer);
    if (std::count(pointer.begin(), pointer.end(), '/') > most_json_levels || !can_be_set(root, at)) throw no_place;
    root[at] = json_of(value).value_or(Json(value));
  } catch (const Json::exception&) {
    throw no_place;
  }
  origins_.push_back({pointer, command_line, pointer});
  const std::vector<Origin> renamed = replace_old_words_in(root, *keys_, JsonPointer(), command_line);
  origins_.insert(origins_.end(), renamed.begin(), renamed.end());
}

std::vector<Document::Origin> Document::replace_old_words_in(Json& object, const ObjectKeys& keys,
                                                             const JsonPointer& pointer, const std::string& file)
{
  std::vector<Origin> origins;
  for (const OldWord& old : replace_old_words(object, keys)) {
    const std::string place = file + "#" + old.place.to_string();
    const std::string note = fmt::format("{}: \"{}\" is now \"{}\"", place, old.word, old.word_now);
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    if (old.is_repeated && file != command_line) {
      problems.push_back(
          {place, fmt::format("the key is given twice, as \"{}\" too", old.word_now), "expected it once"});
    }
    origins.push_back({(pointer / old.place_now).to_string(), file, old.place.to_string()});
  }
  return origins;
}

void Document::merge_file_named_at(const JsonPointer& pointer, const ObjectKeys& keys)
{
  const JsonPointer here = pointer / "file";
  std::error_code ignored;  // then the path as it is will do
  std::set<std::filesystem::path> merged{std::filesystem::weakly_canonical(file_, ignored)};
  while (root.at(pointer).is_object() && root.at(pointer).contains("file")) {
    const std::filesystem::path path = file_named_at(here);
    if (path.empty()) return;
    if (!merged.insert(std::filesystem::weakly_canonical(path, ignored)).second) {
      add_problem(here, fmt::format("{} names itself", path.string()),
                  "expected files that end in one without \"file\"");
      return;
    }
    Json base = object_of(path, here);
    if (base.is_null()) return;
    Json patch = root.at(pointer);
    patch.erase("file");
    const std::vector<Origin> renamed = replace_old_words_in(base, keys, pointer, path.string());
    note_merge(base, patch, pointer, path.string(), renamed);
    note_type(base, patch, pointer, path.string());
    if (base.contains("file")) {
      lay_over(base, patch);
    } else {
      base.merge_patch(patch);
    }
    root.at(pointer) = std::move(base);
  }
}

std::filesystem::path Document::file_named_at(const JsonPointer& pointer)
{
  const Json& name = root.at(pointer);
  if (!name.is_string()) {
    add_problem(pointer, name.dump(), "expected the path of a JSON file");
    return {};
  }
  const std::filesystem::path path = (folder(pointer) / name.get<std::string>()).lexically_normal();
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return path;
  add_problem(pointer, fmt::format("there is no file {}", path.string()), "expected the path of a JSON file");
  return {};
}

Json Document::object_of(const std::filesystem::path& path, const JsonPointer& named_at)
{
  try {
    Json value = parse_json(path);
    add_input(path);
    if (value.is_object()) return value;
    add_problem(named_at, fmt::format("{} holds no object", path.string()), "expected the path of a JSON object");
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems.begin(), error.problems.end());
  }
  return nullptr;
}

void Document::note_merge(const Json& base, const Json& patch, const JsonPointer& pointer, const std::string& path,
                          const std::vector<Origin>& renamed)
{
  const std::string here = pointer.to_string();
  std::vector<Origin> kept;
  for (const Origin& o : origins_) {
    if (!lies_below(o.pointer, here)) kept.push_back(o);
  }
  kept.push_back({here, path, ""});
  kept.insert(kept.end(), renamed.begin(), renamed.end());
  keep_origins(base, patch, pointer, kept);
  // Origins from further down stay, but not those of objects that are now of both: their keys have been noted above.
  const auto is_object = [](const Json& in, const JsonPointer& at) { return in.contains(at) && in.at(at).is_object(); };
  for (const Origin& o : origins_) {
    if (!lies_below(o.pointer, here) || o.pointer == here || o.pointer == here + "/file") continue;
    const JsonPointer below(o.pointer.substr(here.size()));
    if (!(is_object(base, below) && is_object(patch, below))) kept.push_back(o);
  }
  origins_ = std::move(kept);
}

void Document::note_type(const Json& base, const Json& patch, const JsonPointer& pointer, const std::string& path)
{
  if (!base.contains("type") || !patch.contains("type") || !base["type"].is_string()) return;
  if (base["type"] == patch["type"] || overridden_type(pointer) != nullptr) return;
  overridden_types_.push_back({pointer.to_string(), base["type"].get<std::string>(), path});
}

const Document::OverriddenType* Document::overridden_type(const JsonPointer& pointer) const
{
  const auto at = std::find_if(overridden_types_.begin(), overridden_types_.end(),
                               [&](const OverriddenType& one) { return one.pointer == pointer.to_string(); });
  return at == overridden_types_.end() ? nullptr : &*at;
}

void Document::keep_origins(const Json& base, const Json& patch, const JsonPointer& pointer,
                            std::vector<Origin>& kept) const
{
  for (const auto& [key, value] : patch.items()) {
    const JsonPointer here = pointer / key;
    if (value.is_object() && base.contains(key) && base[key].is_object()) {
      keep_origins(base[key], value, here, kept);
    } else {
      const std::string text = here.to_string();
      const Origin from = origin(text);
      kept.push_back({text, from.file, from.pointer_there + text.substr(from.pointer.size())});
    }
  }
}

const Json* find_value(const Json& root, const std::string& pointer)
{
  try {
    const JsonPointer at(pointer);
    return root.contains(at) ? &root.at(at) : nullptr;
  } catch (const Json::exception&) {  // as of an item of twenty digits
    return nullptr;
  }
}

Json to_json(const std::vector<InputFile>& inputs)
{
  Json all = Json::array();
  for (const InputFile& input : inputs) {
    if (input.hash.empty()) continue;
    const std::string file = utf8(std::filesystem::absolute(input.file).lexically_normal().string());
    all.push_back({{"file", file}, {"key", input.pointer}, {"hash", input.hash}});
  }
  return all;
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

void Document::add_input(const std::filesystem::path& file, const std::string& pointer)
{
  const auto is_same = [&](const InputFile& input) { return input.file == file && input.pointer == pointer; };
  if (std::none_of(inputs.begin(), inputs.end(), is_same))
    inputs.push_back({pointer, file, hash_of(read_input_file(file))});
}

void Document::add_unread(const std::filesystem::path& file, const std::string& pointer)
{
  inputs.push_back({pointer, file, ""});
}

void Document::add_problem(const JsonPointer& pointer, std::string found, std::string expected)
{
  problems.push_back({place(pointer), std::move(found), std::move(expected)});
}

}  // namespace tamp::tools
