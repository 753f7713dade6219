#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Reads one material, tables and all. Empty if there is a problem, which the reader's document then knows. Strength
/// that depends on the kind of a scene is that of plane strain, or else of triaxial compression.
std::optional<tasks::SceneMaterial> read_material(const std::string& name, JsonReader reader,
                                                  bool in_plane_strain = false);

/// A material that may be used, and its JSON with every default filled in and paths absolute.
struct CheckedMaterial {
  tasks::SceneMaterial material;
  Json resolved;
  /// Old words in it, a line each, with its place and the word of now.
  std::vector<std::string> notes;
  /// Warnings of what is allowed and hardly ever meant, a line each.
  std::vector<std::string> warnings;
};

/// Reads a material's file by itself, after `assignments` (POINTER=VALUE, pointers into the file). The material's name
/// is the file's without its ending. Throws FileError if the file cannot be read, and InputError with every problem.
CheckedMaterial read_checked_material(const std::filesystem::path& file,
                                      const std::vector<std::string>& assignments = {});

}  // namespace tamp::tools
