#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools::study
{

/// A study that tells how far a scene, on its cells and by its method, is off: it sweeps the cells, beside a method
/// that is on the front, and asks how deep bodies go and what work drives them. `file` is the scene's, `assignments`
/// are what it was read with, and the study is to stand in `folder`. Throws InputError for a scene in which nothing
/// moves.
Json telling_study(const CheckedScene& checked, const std::filesystem::path& file,
                   const std::vector<std::string>& assignments, const std::filesystem::path& folder);

}  // namespace tamp::tools::study
