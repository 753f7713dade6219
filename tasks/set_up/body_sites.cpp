#include "tasks/set_up/body_sites.hpp"

#include <algorithm>
#include <numbers>

#include "components/geometry/cut_lattice.hpp"
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

template <int D>
double sum_of_volumes(const Scene& scene, const SceneBody& body)
{
  double volume = 0;
  for (const components::Site<D>& site : particle_sites<D>(scene, body)) volume += site.volume;
  return volume;
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
  const auto& solid = std::get<components::Solid<D>>(body.solid);
  std::vector<components::Site<D>> sites;
  if (body.particles == ParticleLayout::cut) {
    sites = components::fill_cut(solid, lattice, cells);
  } else {
    const double volume = lattice.particle_volume();
    for (const Vector<D>& x : components::fill(solid, lattice, cells)) sites.push_back({x, volume});
  }
  for (components::Site<D>& site : sites) site.volume *= thickness_at<D>(scene, site.place);
  return sites;
}

double particle_volume(const Scene& scene, const SceneBody& body)
{
  if (!scene.axisymmetric && !body.functions.layout && body.particles == ParticleLayout::lattice) {
    const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
    return static_cast<double>(body.n_particles) * portable::pow(spacing, scene.grid.dimension);
  }
  return scene.grid.dimension == 2 ? sum_of_volumes<2>(scene, body) : sum_of_volumes<3>(scene, body);
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
