#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// Whether gravity and a centrifuge are as their images in planes normal to an axis: the Coriolis force has motion
/// leave a plane that does not turn about its own normal.
bool loads_are_mirrored(const tasks::Scene& scene, std::size_t axis);

/// Whether a pressure on a body that reaches as far [m] to both sides of the plane normal to an axis at `place` [m] is
/// as its image in that plane.
bool is_mirrored(const components::PressedBox<3>& pressed, std::size_t axis, double place, double reach);

/// Whether the scene is one cell thick along an axis, between smooth walls: a slab in plane strain.
bool is_one_cell_thick(const tasks::Scene& scene, int axis);

/// The first axis whose faces may be planes of symmetry: r = 0 of an axisymmetric scene is a line.
std::size_t first_axis_with_planes(const tasks::Scene& scene);

/// The faces of the grid that are planes of symmetry of a larger whole, of which the scene is a part: that cut a body,
/// or along which a body moves that lies on them. Other "symmetry" faces are smooth walls. Where a body lies on both
/// faces of an axis, they are the walls that it moves between.
tasks::Sides planes_of_symmetry(const tasks::Scene& scene);

/// Axes normal to which the scene has a plane of symmetry halfway through the grid, as far as the sites of particles
/// tell: half the scene gives all of it.
std::vector<std::size_t> symmetric_axes(const tasks::Scene& scene);

/// Advice to run half or a quarter of the scene, with how that is written and what its steps cost; empty where it is
/// not symmetric.
std::optional<std::string> advice_to_halve(const tasks::Scene& scene);

}  // namespace tamp::tools
