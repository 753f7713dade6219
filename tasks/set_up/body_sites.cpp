#include "tasks/set_up/body_sites.hpp"

#include <algorithm>
#include <numbers>

#include "components/geometry/fill.hpp"
#include "components/geometry/sampled_volume.hpp"
#include "components/portable_math.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

namespace
{

/// The length of the circle that a site makes where the plane is turned about the axis, or the thickness of the slab.
template <int D>
double thickness_at(const Scene& scene, const Vector<D>& x)
{
  return scene.axisymmetric ? 2 * std::numbers::pi * x[0] : 1;
}

}  // namespace

template <int D>
std::vector<components::Site<D>> particle_sites(const Scene& scene, const SceneBody& body)
{
  const auto lattice = lattice_of<D>(scene, body.material);
  if constexpr (D == 2) {
    if (body.functions.layout)
      return body.functions.layout->sites(lattice.cell_size / lattice.n_per_axis, scene.axisymmetric);
  }
  components::CellRange<D> cells{};
  std::copy_n(scene.grid.n_cells.begin(), D, cells.upper.begin());
  std::vector<components::Site<D>> sites;
  const double volume = lattice.particle_volume();
  for (const Vector<D>& x : components::fill(std::get<components::Solid<D>>(body.solid), lattice, cells)) {
    sites.push_back({x, volume * thickness_at<D>(scene, x)});
  }
  return sites;
}

double particle_volume(const Scene& scene, const SceneBody& body)
{
  if (scene.axisymmetric) {
    double volume = 0;
    for (const components::Site<2>& site : particle_sites<2>(scene, body)) volume += site.volume;
    return volume;
  }
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  if (!body.functions.layout) {
    return static_cast<double>(body.n_particles) * portable::pow(spacing, scene.grid.dimension);
  }
  double volume = 0;
  for (const components::Site<2>& site : body.functions.layout->sites(spacing, false)) volume += site.volume;
  return volume;
}

components::Volume solid_volume(const Scene& scene, const SceneBody& body)
{
  if (!scene.axisymmetric) return std::visit([](const auto& solid) { return solid.volume(); }, body.solid);
  const auto& solid = std::get<components::Solid<2>>(body.solid);
  return components::sampled_integral<2>(
      solid.bounding_box(), [&](const Vector<2>& x) { return solid.contains(x) ? 2 * std::numbers::pi * x[0] : 0.0; });
}

template std::vector<components::Site<2>> particle_sites(const Scene&, const SceneBody&);
template std::vector<components::Site<3>> particle_sites(const Scene&, const SceneBody&);

}  // namespace tamp::tasks
