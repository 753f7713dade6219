#pragma once

#include <filesystem>
#include <optional>

#include "tools/study/compare/comparison.hpp"
#include "tools/study/compare/model_scenes.hpp"

namespace tamp::tools::compare
{

/// A scene of the comparison on cells twice as large; none where the domain or its bodies do not allow that. What this
/// changes is a measure of the grid's error: of a method of first order just that, of one of second order three times
/// it.
std::optional<ModelScene> coarser_scene(const std::filesystem::path& file, const ModelScene& scene);

/// Runs it to a time [s], in a folder that exists.
ModelResult run_coarser(const ModelScene& scene, double until, int n_threads, const std::filesystem::path& folder);

}  // namespace tamp::tools::compare
