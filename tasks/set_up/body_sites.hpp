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

/// Their places alone.
template <int D>
std::vector<Vector<D>> sites_of(const Scene& scene, const SceneBody& body)
{
  std::vector<Vector<D>> places;
  for (const components::Site<D>& site : particle_sites<D>(scene, body)) places.push_back(site.place);
  return places;
}

/// Their volume, all together [m^3].
double particle_volume(const Scene& scene, const SceneBody& body);

/// That of the body's solid, in an axisymmetric scene of what turning it about the axis makes of it.
components::Volume solid_volume(const Scene& scene, const SceneBody& body);

}  // namespace tamp::tasks
