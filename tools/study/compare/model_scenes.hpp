#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools::compare
{

/// A scene with the elasticity of its sands replaced by one model.
struct ModelScene {
  /// The model's name; one that is named again gets a number, `table-2`, so that a model can be compared with itself.
  std::string name;
  /// POINTER=VALUE: what makes this scene of the file.
  std::vector<std::string> assignments;
  CheckedScene scene;
};

/// Names of the models: those that a scene can name, and each of them compiled.
const std::vector<std::string>& model_names();

/// The scene once for each model, with `assignments` made first. Throws InputError for an unknown model and for a scene
/// without tabular sand, and what read_scene throws.
std::vector<ModelScene> read_model_scenes(const std::filesystem::path& file,
                                          const std::vector<std::string>& assignments,
                                          const std::vector<std::string>& models);

}  // namespace tamp::tools::compare
