#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scene/json/json_reader.hpp"
#include "tools/study/study.hpp"
#include "tools/study/study_keys.hpp"

namespace tamp::tools::study
{

/// A study's file that is being read: its keys, what has been read of it so far, and what its parts are made of. Each
/// function that reads a key notes what is wrong with it, and then returns something harmless.
struct StudyReader {
  explicit StudyReader(Document& file) : document(file), root(file, study_keys()) {}

  std::string pointer(JsonReader& reader, const std::string& key);
  /// The text at a key, which must not be empty.
  static std::string needed_text(JsonReader& reader, const std::string& key);
  std::vector<std::string> names(JsonReader& reader, const std::string& key);
  std::vector<Json> list(JsonReader& reader, const std::string& key);
  Settings settings(JsonReader& reader, const std::string& key);
  /// The settings in an object that stands somewhere below the key.
  Settings settings_of(const Json& object, JsonReader& reader, const std::string& key);
  std::vector<Axis> axes(JsonReader& reader, const std::string& key);
  /// Files are named from the study's folder; commands name them from the current one.
  static std::filesystem::path from_here(const std::filesystem::path& file);

  /// Null if there is none.
  Method* find_method(const std::string& name);
  bool find_quantity(const std::string& name) const;
  bool has_exact_answer(const std::string& name) const;
  /// Whether it has an exact answer, or the study a reference.
  bool has_error(const std::string& name) const;

  Document& document;
  JsonReader root;
  Study study;

 private:
  Json with_file_from_here(const Json& value) const;
};

}  // namespace tamp::tools::study
