#pragma once

#include <optional>

#include "components/geometry/solid.hpp"
#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// The "symmetry" faces beyond which a solid reaches, which cut it. Adds a problem with the key "geometry" where it
/// reaches beyond another face.
template <int D>
std::optional<tasks::Sides> mirrors_crossed(const components::Solid<D>& solid, const tasks::Scene& scene,
                                            const JsonReader& reader);

/// The part of a solid within the grid, which mirrors cut: half of a body is written as the whole, in a grid that ends
/// at its plane of symmetry. Adds a problem where the sites that the whole would have particles at tell that what lies
/// beyond is not the mirror image of what lies within.
template <int D>
std::optional<components::Solid<D>> cut_at_mirrors(const components::Solid<D>& whole, const tasks::Sides& mirrors,
                                                   const tasks::Scene& scene, int material, const JsonReader& reader);

}  // namespace tamp::tools
