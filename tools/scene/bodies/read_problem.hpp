#pragma once

#include <optional>

#include "components/problems/problem.hpp"
#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// The object "problem" of a body; empty if there is none, or a problem with it, which the reader's document then
/// knows.
std::optional<components::Problem> read_problem(JsonReader& body);

/// The functions of a problem, set for a body of this material; empty if it cannot be, which the document then knows.
std::optional<components::BodyFunctions> functions_of(const components::Problem& problem, const JsonReader& body,
                                                      const tasks::Scene& scene, const tasks::SceneMaterial& material);

/// Adds what in a scene does not go with the functions of one of its bodies.
template <int D>
void check_functions(const tasks::Scene& scene, const tasks::SceneBody& body, const JsonReader& reader);

}  // namespace tamp::tools
