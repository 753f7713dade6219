#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tasks/scene.hpp"
#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// A scene that may be run, and its JSON with every default filled in, material files merged in, and paths absolute.
struct CheckedScene {
  tasks::Scene scene;
  Json resolved;
  std::vector<InputFile> inputs;
  /// Old words in it, a line each, with its place and the word of now.
  std::vector<std::string> notes{};
  /// The keys that it leaves out, by their pointers: they have their defaults.
  std::vector<std::string> left_out{};
  /// Warnings of what is allowed and hardly ever meant, a line each: the first of its plausibility_warnings.
  std::vector<std::string> warnings{};
  /// Remarks on its files, a line each.
  std::vector<std::string> remarks{};
};

/// Reads a scene's file, applies `assignments` (POINTER=VALUE) in order, and checks all of it. The keys are those of
/// docs/reference/scene.md. Throws FileError if the file cannot be read, and InputError with every problem of the
/// scene.
CheckedScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& assignments = {});

}  // namespace tamp::tools
