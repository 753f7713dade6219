#pragma once

#include <fmt/core.h>

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "components/choice.hpp"
#include "components/range.hpp"
#include "tools/scene/json/document.hpp"

/// Names, values and meanings of the keys of scenes: said here once, for the readers, the JSON schema and the tables of
/// docs/reference/scene.md.
namespace tamp::tools
{

using components::above_zero;
using components::any_number;
using components::Range;
using components::zero_or_above;

struct ObjectKeys;
/// Keys may be those of an object that holds others of its own kind, so that they are asked for when they are needed.
using KeysOf = const ObjectKeys& (*)();

/// Entries of a list, in scenes of two and of three dimensions.
struct Length {
  int in_plane;
  int in_space;
};
inline constexpr Length per_axis{2, 3}, per_rotation{1, 3}, time_and_axes{3, 4};
constexpr Length just(int n)
{
  return {n, n};
}

struct Text {
};
struct Flag {
};
struct File {
};
/// An object that may stand in place of a word, with parameters of what it chooses.
struct Instead {
  KeysOf keys;
  /// As a message shows it.
  std::string shown;
  int value;
};
/// The name of a material, which the user chose; a reader knows which there are.
struct Name {
  /// May stand there instead; the names may not be one of them.
  std::vector<std::string> words{};
  std::vector<Instead> instead{};
};
struct Names {
  Length length;
};
/// A list of any of the names that a reader knows, each once.
struct SomeNames {
};
/// A value that is not read.
struct Anything {
};
struct Number {
  Range range = any_number;
  /// May stand there instead.
  std::string word{};
};
struct Numbers {
  Length length;
  Range range = any_number;
};
struct WholeNumber {
  int least, most;
};
struct WholeNumbers {
  Length length;
  int least, most;
};
/// A list of lists of numbers.
struct Rows {
  Length length;
};
struct Choice {
  std::vector<std::string> words;
  /// The value of each word in code: those of an enumeration; none where the word itself is used.
  std::vector<int> values{};
  std::vector<Instead> instead{};
  /// Words of earlier versions that are still read, each with the word of now.
  std::map<std::string, std::string> old_words{};
  /// The meaning of each word, in Markdown; empty where the meaning of the key says it all.
  std::vector<std::string> meanings{};
};
struct Object {
  KeysOf keys;
};
/// An object whose members, under names that the user chose, have these keys.
struct Members {
  KeysOf keys;
};
/// A list of objects.
struct Objects {
  KeysOf keys;
};
using Value = std::variant<Text, Flag, File, Name, Names, SomeNames, Anything, Number, Numbers, WholeNumber,
                           WholeNumbers, Rows, Choice, Object, Members, Objects>;

/// The value of a key that is left out.
struct Default {
  /// Null where there is none, or none that is known without the rest of the scene; for lists each entry.
  Json value = nullptr;
  /// For people, where the value does not tell.
  std::string words{};
  bool compulsory = false;
};
inline const Default compulsory{nullptr, "*compulsory*", true}, none{nullptr, "none"};

struct Key {
  std::string name;
  Value value;
  /// SI, such as "kg/m^3".
  std::string unit;
  Default default_value;
  /// In Markdown, half a line for people. Keys that follow each other and mean the same share a row of a table.
  std::string meaning;
  /// The dimension of the scenes that have the key; 0: all.
  int only_in = 0;
  /// The name of earlier versions, where that is still read.
  std::string old_name{};
};

/// A word of the key "type", and the keys that go with it.
struct TypeKeys {
  std::string word;
  std::vector<Key> keys;
  std::string meaning{};
  int only_in = 0;
};

struct ObjectKeys {
  /// The name of an object that the documentation shows in a table of its own, and the schema in a definition; the
  /// keys of others stand with those around them.
  std::string name;
  std::vector<Key> keys;
  /// Where there are any, the compulsory key "type" names one of them.
  std::vector<TypeKeys> types{};
  /// Whether it may stand in a file of its own. It may then name another one under the key "file", over whose object
  /// its other keys are merged (RFC 7386), and for editors a schema under "$schema", which is passed over.
  bool may_be_a_file = false;
};

/// The meanings of the words of a list, one after another.
template <class T>
std::string meanings_of(const std::vector<components::Word<T>>& words)
{
  std::string text;
  for (const auto& [word, value, meaning, old_word] : words) {
    text += fmt::format("{}`\"{}\"`: {}", text.empty() ? "" : "; ", word, meaning);
  }
  return text;
}

/// A key whose words stand for values of an enumeration, or of a Choice.
template <class T>
Key choice(std::string name, T default_value, const std::vector<components::Word<T>>& words, std::string meaning,
           std::vector<Instead> instead = {})
{
  Choice choice{.words = {}, .instead = std::move(instead)};
  Default left_out;
  for (const auto& [word, value, meaning_of_word, old_word] : words) {
    choice.words.emplace_back(word);
    choice.meanings.emplace_back(meaning_of_word);
    if (!old_word.empty()) choice.old_words.emplace(old_word, word);
    choice.values.push_back(static_cast<int>(value));
    if (value == default_value) left_out.value = word;
  }
  return {std::move(name), std::move(choice), "", std::move(left_out), std::move(meaning)};
}

inline constexpr int most_particles_per_axis = 16;
/// Outputs of a run whose scene does not say how many.
inline constexpr int usual_field_outputs = 50, usual_history_rows = 1000;

const ObjectKeys& scene_keys();
const ObjectKeys& centrifuge_keys();
const ObjectKeys& contact_keys();
const ObjectKeys& body_keys();
const ObjectKeys& drive_keys();
const ObjectKeys& pressure_keys();
const ObjectKeys& problem_keys();
const ObjectKeys& solid_keys();
const ObjectKeys& material_keys();

}  // namespace tamp::tools
