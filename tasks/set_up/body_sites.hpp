#pragma once

#include <vector>

#include "components/geometry/polar_layout.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The particles of a body where they lie undeformed [m], with their volumes [m^3]: in the layout that its functions
/// give, or at the sites of its material's lattice, cut at its outline or not.
template <int D>
std::vector<components::Site<D>> particle_sites(const Scene& scene, const SceneBody& body);

/// The positions of these particles, without their volumes [m].
template <int D>
std::vector<Vector<D>> sites_of(const Scene& scene, const SceneBody& body)
{
  std::vector<Vector<D>> places;
  for (const components::Site<D>& site : particle_sites<D>(scene, body)) places.push_back(site.place);
  return places;
}

/// The volume of all these particles together [m^3].
double particle_volume(const Scene& scene, const SceneBody& body);

/// The volume of the body's solid; in an axisymmetric scene, of the solid of revolution about the axis.
components::Volume solid_volume(const Scene& scene, const SceneBody& body);

}  // namespace tamp::tasks
