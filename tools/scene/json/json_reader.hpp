#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/scene/json/keys.hpp"

namespace tamp::tools
{

/// `found` of a problem with a key that is not declared.
inline constexpr char unknown_key[] = "unknown key";

/// Reads an object of a document by its keys (keys.hpp), which say what each may hold. Each function that reads a key
/// writes its default back where it has one, and adds what is wrong to the document's problems; it then returns
/// something harmless, so that the rest is checked too. A key whose value is null counts as left out. A key that has no
/// default has to be there when it is read. To read a key that is not declared, or as what it is not, is an error of
/// the program.
class JsonReader
{
 public:
  JsonReader(Document& document, const ObjectKeys& keys, JsonPointer pointer = JsonPointer());

  bool has(const std::string& key) const;

  double number(const std::string& key);
  /// With a default that only the reader knows.
  double number(const std::string& key, double default_value);
  std::optional<double> optional_number(const std::string& key);
  int whole_number(const std::string& key);
  /// A list of numbers, such as one for each axis.
  std::vector<double> numbers(const std::string& key);
  std::optional<std::vector<double>> optional_numbers(const std::string& key);
  std::vector<int> whole_numbers(const std::string& key);
  /// A list of lists of numbers.
  std::vector<std::vector<double>> rows(const std::string& key);
  bool flag(const std::string& key);
  std::string text(const std::string& key, const std::string& default_value);
  /// Whether the word stands at the key that is allowed in place of a number.
  bool has_word(const std::string& key) const;
  /// Whether an object stands there, which `object` then reads.
  bool is_object(const std::string& key) const;
  /// The word of a choice at a key, or empty if it is none of the choice's words.
  std::string word(const std::string& key);
  /// The value of the word at a key, or of the object in its place; that of the first word if it is neither.
  template <class Enum>
  Enum choice(const std::string& key)
  {
    return static_cast<Enum>(value_of_choice(key));
  }
  /// The word at "type", whose keys are keys from now on; empty if it is none, or stands over another type of the file
  /// that the object names, with keys that go with that type alone.
  std::string type();
  /// The value of the object that stands at the key in place of a word or a name; none where it is no object, or none
  /// may stand there.
  std::optional<int> value_of_object(const std::string& key) const;
  /// The name at a key, one of `names` or of the words that may stand there instead; empty if it is neither.
  std::string name(const std::string& key, const std::vector<std::string>& names);
  /// With a default that only the reader knows.
  std::string name(const std::string& key, const std::vector<std::string>& names, const std::string& default_value);
  /// A list of some of `names`; empty if it is none.
  std::vector<std::string> names(const std::string& key, const std::vector<std::string>& names);
  /// The path of a file that exists, made absolute in the document too.
  std::filesystem::path existing_file(const std::string& key);
  /// Makes the path of a file that is not needed absolute in the document.
  void pass_over_file(const std::string& key);

  /// The object at a key. Without it a reader that finds nothing and reports nothing.
  JsonReader object(const std::string& key);
  std::optional<JsonReader> optional_object(const std::string& key);
  /// The keys of an object that is there; nothing is noted.
  std::vector<std::string> members_of(const std::string& key) const;
  /// The members of an object whose keys are names that the user chose.
  std::vector<std::pair<std::string, JsonReader>> members(const std::string& key);
  /// A list of any of `names`, each once; by default all.
  std::vector<std::string> some_of(const std::string& key, const std::vector<std::string>& names);
  /// The objects of a list.
  std::vector<JsonReader> objects(const std::string& key);

  /// Notes numbers of the object, alone or in its lists, that are too large for a few of them to be multiplied.
  void expect_numbers_to_multiply() const;

  /// The key's value has a meaning, but a wrong one.
  void add_problem(const std::string& key, const std::string& found, const std::string& expected) const;

  /// To be called at the end: keys that are not declared for such a scene are problems.
  void finish() const;

  Document& document() const { return *document_; }
  JsonPointer pointer(const std::string& key) const { return pointer_ / key; }
  std::string place(const std::string& key) const { return document_->place(pointer_ / key); }

 private:
  std::vector<const std::vector<Key>*> declared() const;
  const std::vector<Instead>& instead(const std::string& key) const;
  std::string shown_instead(const std::string& key) const;
  /// The kind of object that stands at a key, among those that may: the first that has one of its keys.
  const Instead& object_instead(const std::string& key) const;
  const Key& declared(const std::string& key) const;
  /// Notes a type that differs from that of the file from which keys come. Returns whether it does.
  bool is_over_type_of_file(const std::string& type) const;
  template <class Kind>
  const Kind& declared_as(const std::string& key) const
  {
    return std::get<Kind>(declared(key).value);
  }
  bool is_in_scene(int only_in) const;
  std::size_t count(Length length) const;

  const Json* find(const std::string& key) const;
  /// As `find`, but the key must be there.
  const Json* require(const std::string& key, const std::string& expected) const;
  void write(const std::string& key, Json value);
  /// Writes the value that a key has where it is left out, and notes that it was.
  void fill_in(const std::string& key, Json value);
  void write_default(const std::string& key, std::size_t n_entries = 0);
  /// `also` is named in the message beside the words.
  std::string one_of(const std::string& key, const std::vector<std::string>& words, const std::string& also = "") const;
  int value_of_choice(const std::string& key);
  template <class T>
  std::vector<T> list(const std::string& key, std::size_t n, const std::string& expected, bool (*fits)(const Json&));
  JsonReader at(const std::string& key, const ObjectKeys& keys) const;
  /// A path that stands at a key, seen from the current folder.
  std::filesystem::path path(const std::string& key, const std::string& text) const;
  void write_path(const std::string& key, const std::filesystem::path& path);

  Document* document_;
  JsonPointer pointer_;
  const ObjectKeys* object_;
  /// The keys of the type, when it is known.
  const TypeKeys* type_ = nullptr;
  /// False where a problem with this whole object has been noted already.
  bool exists_ = true;
};

}  // namespace tamp::tools
