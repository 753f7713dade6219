#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/range.hpp"
#include "tools/scene/document.hpp"

namespace tamp::tools
{

using components::above_zero;
using components::any_number;
using components::Range;
using components::zero_or_above;

/// Reads the keys of one object of a document. Each function that reads a key notes that the key is known, writes a
/// default back where there is one, and adds what is wrong to the document's problems; it then returns something
/// harmless, so that the rest is checked too. A key whose value is null counts as left out.
/// Functions without a default make the key compulsory. `unit` is said in messages only, such as "kg/m^3".
class JsonReader
{
 public:
  explicit JsonReader(Document& document, JsonPointer pointer = JsonPointer());

  bool has(const std::string& key) const;
  /// The key has a meaning, even where it is not read.
  void allow(const std::string& key) { known_.push_back(key); }

  double number(const std::string& key, Range range, const std::string& unit = "");
  double number(const std::string& key, Range range, double default_value);
  std::optional<double> optional_number(const std::string& key, Range range);
  int integer(const std::string& key, int least, int most);
  int integer(const std::string& key, int least, int most, int default_value);
  /// A list of just `n` numbers, such as one for each axis.
  std::vector<double> numbers(const std::string& key, std::size_t n, Range range);
  std::vector<double> numbers(const std::string& key, std::size_t n, Range range, double default_value);
  /// A list of lists of `n` numbers.
  std::vector<std::vector<double>> rows(const std::string& key, std::size_t n);
  std::vector<int> integers(const std::string& key, std::size_t n, int least, int default_value);
  bool flag(const std::string& key, bool default_value);
  /// Whether an object stands there, which `object` then reads.
  bool is_object(const std::string& key);
  /// Whether this word stands there instead of what the key usually has.
  bool is_text(const std::string& key, const std::string& word);
  std::string text(const std::string& key, const std::string& default_value);
  /// One of `choices`, or empty if it is none; the first is the default where `has_default`.
  std::string choice(const std::string& key, const std::vector<std::string>& choices, bool has_default = false);
  /// The path of a file that exists, made absolute in the document too.
  std::filesystem::path existing_file(const std::string& key);
  /// The key has a meaning, and its path is made absolute in the document, but its file is not needed.
  void allow_file(const std::string& key);

  /// The object at a key. Without it a reader that finds nothing and complains of nothing.
  JsonReader object(const std::string& key);
  std::optional<JsonReader> optional_object(const std::string& key);
  /// As `object`, but an empty one where the key is left out.
  JsonReader object_or_empty(const std::string& key);
  /// The keys of an object that is there; nothing is noted.
  std::vector<std::string> names(const std::string& key) const;
  /// The members of an object whose keys are names that the user chose.
  std::vector<std::pair<std::string, JsonReader>> members(const std::string& key);
  /// The objects of a list; none where the key is left out.
  std::vector<JsonReader> items(const std::string& key);
  /// A list of `n` of the choices; empty if it is none.
  std::vector<std::string> choices(const std::string& key, std::size_t n, const std::vector<std::string>& choices);
  /// A list of any of the choices, each once; by default all.
  std::vector<std::string> some_of(const std::string& key, const std::vector<std::string>& choices);

  /// The key's value has a meaning, but a wrong one.
  void add_problem(const std::string& key, const std::string& found, const std::string& expected) const;

  /// To be called when all keys have been read: the others are unknown, and are problems.
  void finish() const;

  Document& document() const { return *document_; }
  JsonPointer pointer(const std::string& key) const { return pointer_ / key; }
  std::string place(const std::string& key) const { return document_->place(pointer_ / key); }

 private:
  const Json* find(const std::string& key);
  /// As `find`, but the key must be there.
  const Json* require(const std::string& key, const std::string& expected);
  void write(const std::string& key, Json value);
  template <class T>
  std::vector<T> list(const std::string& key, std::size_t n, const std::string& expected, bool (*fits)(const Json&),
                      bool compulsory);
  static JsonReader nothing(Document& document);
  /// A path that stands at a key, seen from the current folder.
  std::filesystem::path path(const std::string& key, const std::string& text) const;
  void write_path(const std::string& key, const std::filesystem::path& path);

  Document* document_;
  JsonPointer pointer_;
  /// False where a problem with this whole object has been noted already.
  bool exists_ = true;
  std::vector<std::string> known_;
};

}  // namespace tamp::tools
