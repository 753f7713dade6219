#pragma once

#include <optional>

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// The object "pressure" of a body in a scene of D dimensions; without it, or with a bad one, nothing.
template <int D>
std::optional<tasks::BodyPressure> read_pressure(JsonReader& body);

/// Does the pressure act on some of the body's surface, and may it? `reader` is the body's.
template <int D>
void check_pressed(const tasks::Scene& scene, const tasks::SceneBody& body, JsonReader& reader);

}  // namespace tamp::tools
