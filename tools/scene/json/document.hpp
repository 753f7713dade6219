#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene/files/input_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

/// Keeps the order of keys: materials and bodies are numbered as they stand in the file.
using Json = nlohmann::ordered_json;
using JsonPointer = Json::json_pointer;

struct ObjectKeys;

/// A scene being read: its JSON, where each part of it came from, and what was found to be wrong so far. Reading fills
/// in defaults, so that at the end `root` is the scene as resolved.
class Document
{
 public:
  /// Reads a file whose object has these keys (keys.hpp). Old words in it, and in all that comes in later, are replaced
  /// by those of now. Throws FileError if it cannot be opened, InputError for what `parse_json` refuses.
  Document(const std::filesystem::path& file, const ObjectKeys& keys);

  /// Applies `POINTER=VALUE`: the value is JSON, or else a string; objects on the way are made. Throws InputError for
  /// an assignment that cannot be made; whether the place has a meaning shows when it is read.
  void set(const std::string& assignment);

  /// Replaces the object at `pointer`, which has these keys and the key "file", by that file's JSON with the object's
  /// other keys merged over it (RFC 7386); again if that file names another. Without that key nothing happens; what
  /// goes wrong is added to the problems.
  void merge_file_named_at(const JsonPointer& pointer, const ObjectKeys& keys);

  /// FILE#/pointer of the value, in the file that it came from.
  std::string place(const JsonPointer& pointer) const;

  /// The folder that a relative path at `pointer` starts from.
  std::filesystem::path folder(const JsonPointer& pointer) const;

  /// A "type" in a file where the object that names the file has another "type".
  struct OverriddenType {
    std::string pointer;  ///< of the object
    std::string type;     ///< the file's
    std::string file;
  };
  /// The overridden type of the object at `pointer`; null where there is none.
  const OverriddenType* overridden_type(const JsonPointer& pointer) const;

  void add_problem(const JsonPointer& pointer, std::string found, std::string expected);

  /// Notes that `file`, named at `pointer` (none for the scene itself and what is merged into it), is read for it.
  void add_input(const std::filesystem::path& file, const std::string& pointer = "");
  /// Notes a file that is named, and not read.
  void add_unread(const std::filesystem::path& file, const std::string& pointer);

  const std::filesystem::path& file() const { return file_; }

  Json root;
  std::vector<Problem> problems;
  /// The old words that were replaced, a line each, with its place.
  std::vector<std::string> notes;
  /// Warnings of what is allowed and hardly ever meant, a line each, with its pointer.
  std::vector<std::string> warnings;
  /// Remarks on its files, a line each, with its pointer, which `tamp check` prints.
  std::vector<std::string> remarks;
  /// Every file that has been read for it, in the order in which they were named.
  std::vector<InputFile> inputs;
  /// The keys that were left out, by their pointers: `root` has their defaults.
  std::vector<std::string> left_out;
  /// Dimension of the scene, 2 or 3, when it has been read; 0 before, and where there is no scene.
  int dimension = 0;
  /// Whether the plane of the scene is turned about x = 0, when that has been read.
  bool axisymmetric = false;
  /// Solids that have been read so far.
  std::size_t n_solids = 0;

 private:
  /// All below `pointer` stands in `file`, below `pointer_there`. The longest match counts, of two alike the last.
  struct Origin {
    std::string pointer;
    std::string file;
    std::string pointer_there;
  };
  Origin origin(const std::string& pointer) const;

  /// The path at `pointer`; empty, with a problem noted, if no file is there.
  std::filesystem::path file_named_at(const JsonPointer& pointer);
  /// The object of a file; null, with problems noted, if it holds none.
  Json object_of(const std::filesystem::path& path, const JsonPointer& named_at);
  /// Replaces old words in an object from `file` that stands, or will stand, at `pointer`, and notes them. Returns the
  /// origins of what they name. A file that has a key under both its names is a problem; an assignment overrides.
  std::vector<Origin> replace_old_words_in(Json& object, const ObjectKeys& keys, const JsonPointer& pointer,
                                           const std::string& file);
  /// All at `pointer` comes from `path` now, with renamed parts, but for what `patch` overrides in `base`: that stays
  /// from where it was.
  void note_merge(const Json& base, const Json& patch, const JsonPointer& pointer, const std::string& path,
                  const std::vector<Origin>& renamed);
  void note_type(const Json& base, const Json& patch, const JsonPointer& pointer, const std::string& path);
  void keep_origins(const Json& base, const Json& patch, const JsonPointer& pointer, std::vector<Origin>& kept) const;

  std::filesystem::path file_;
  const ObjectKeys* keys_;
  std::vector<Origin> origins_;
  std::vector<OverriddenType> overridden_types_;
};

/// The value at a pointer that someone wrote; null where there is none, or where the text is no pointer.
const Json* find_value(const Json& root, const std::string& pointer);

/// The files that were read, each with its key (none for the scene itself and what is merged into it) and its hash.
Json to_json(const std::vector<InputFile>& inputs);

/// The result of `read`; none if it throws InputError, whose problems are then the document's.
template <class Read>
auto noting_problems(Document& document, Read read) -> std::optional<decltype(read())>
{
  try {
    return read();
  } catch (const InputError& error) {
    document.problems.insert(document.problems.end(), error.problems.begin(), error.problems.end());
    return std::nullopt;
  }
}

}  // namespace tamp::tools
