#include "tasks/method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/geometry/mirrored.hpp"
#include "components/portable_math.hpp"

namespace tamp::tasks
{

namespace
{

/// An edge is on a node to within 1e-12 cells; the weight there is the square of that.
constexpr double least_weight = 1e-24;

double least_particle_mass(const Scene& scene)
{
  double least = std::numeric_limits<double>::infinity();
  for (int m = 0; m < static_cast<int>(scene.materials.size()); ++m) {
    const double size = scene.grid.cell_size / scene.particles_per_axis_of(m);
    const double density = scene.materials[static_cast<std::size_t>(m)].density;
    least = std::min(least, density * portable::pow(size, scene.axisymmetric ? 3 : scene.grid.dimension));
  }
  return least;
}

/// A body with its images beyond the planes of symmetry that it lies on.
template <int D>
components::Solid<D> whole_of(const Scene& scene, const SceneBody& body)
{
  auto whole = std::get<components::Solid<D>>(body.solid);
  const components::Box<D> box = whole.bounding_box();
  const double slack = 1e-9 * scene.grid.cell_size;
  for (int axis = 0; axis < D; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for (const int side : {0, 1}) {
      if (!components::traits_of(scene.faces[k][static_cast<std::size_t>(side)]).is_mirror) continue;
      const double plane = scene.grid.coordinate(axis, side == 0 ? 0 : scene.grid.n_cells[k]);
      const bool lies_on_it = side == 0 ? box.lower[axis] <= plane + slack : box.upper[axis] >= plane - slack;
      if (!lies_on_it) continue;
      whole = components::Solid<D>(components::Mirrored<D>{whole, axis, plane, side == 0 ? -1 : 1});
    }
  }
  return whole;
}

}  // namespace

template <int D>
Method<D>::Method(const Scene& given)
    : scene(given),
      halo(components::n_layers_beyond(scene.interpolator)),
      carried_gradient(carried_gradient_of(scene.transfer)),
      passes(with_transfer([](const auto& transfer) { return transfer.passes; })),
      n_passes(with_transfer([](const auto& transfer) { return transfer.n_passes(); })),
      amplification(with_transfer([](const auto& transfer) -> double { return transfer.amplification(); })),
      deformation_update(scene.deformation_update),
      anti_locking(scene.anti_locking),
      stress_timing(scene.stress_timing),
      axisymmetric(scene.axisymmetric),
      cell_size(scene.grid.cell_size),
      least_node_mass(least_weight * least_particle_mass(scene)),
      gravity(vector_of<D>(scene.gravity)),
      centrifuge(scene.centrifuge),
      viscosity(scene.artificial_viscosity),
      damping(scene.local_damping),
      time_step_rule(scene.time.rule),
      contacts(static_cast<int>(scene.materials.size())),
      materials(scene.materials)
{
  for (int m = 0; m < static_cast<int>(scene.materials.size()); ++m) {
    interpolations.push_back(
        components::Interpolation<D>::make(scene.interpolator, scene.particles_per_axis_of(m), scene.plane()));
    const auto is_pressed = [m](const SceneBody& body) { return body.is_pressed() && body.material == m; };
    if (std::any_of(scene.bodies.begin(), scene.bodies.end(), is_pressed)) pressed_materials.push_back(m);
    const auto is_rigid = [m](const SceneBody& body) { return body.rigid && body.material == m; };
    const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(), is_rigid);
    if (body == scene.bodies.end()) {
      deformable_materials.push_back(m);
    } else {
      rigid_bodies.push_back(make_rigid_body(scene, static_cast<int>(body - scene.bodies.begin())));
    }
  }
  for (std::size_t k = 0; k < std::size_t{D}; ++k) {
    for (std::size_t side = 0; side < 2; ++side) {
      const components::FaceTraits traits = components::traits_of(scene.faces[k][side]);
      mirrors[k][side] = traits.has_image() && !scene.grid.periodic[k];
      const int axis = static_cast<int>(k);
      if (!traits.is_wall()) continue;
      (traits.at_edges ? edge_walls : image_walls)
          .push_back({axis, side == 0 ? -1 : 1, scene.grid.coordinate(axis, side == 0 ? 0 : scene.grid.n_cells[k])});
    }
  }
  for (const SceneContact& pair : scene.contacts)
    contacts.set(pair.material_a, pair.material_b, pair.friction, pair.normal);
  for (const RigidBody& body : rigid_bodies) {
    solids.push_back(whole_of<D>(scene, scene.bodies[static_cast<std::size_t>(body.body)]));
  }
  for (const int material : deformable_materials) {
    const auto meets = [&](const RigidBody& body) { return meets_by_solid(body, material); };
    if (std::any_of(rigid_bodies.begin(), rigid_bodies.end(), meets)) touch_solids.push_back(material);
  }
}

template <int D>
bool Method<D>::meets_by_solid(const RigidBody& body, int material) const
{
  return std::holds_alternative<components::SolidNormal>(contacts.normal(body.material, material));
}

template <int D>
std::vector<int> Method<D>::rigid_materials() const
{
  std::vector<int> of_bodies;
  of_bodies.reserve(rigid_bodies.size());
  for (const RigidBody& body : rigid_bodies) of_bodies.push_back(body.material);
  return of_bodies;
}

template <int D>
double Method<D>::work_function(const Vector<D>& x) const
{
  double work = gravity.dot(x);
  if constexpr (D == 3) {
    if (centrifuge && centrifuge->is_steady()) work += centrifuge->work_function(x);
  }
  return work;
}

template <int D>
bool Method<D>::needs_surface_of(int material) const
{
  const bool is_pressed =
      std::find(pressed_materials.begin(), pressed_materials.end(), material) != pressed_materials.end();
  return is_pressed || contacts.needs_surface_of(material);
}

template <int D>
const RigidBody* Method<D>::rigid_body(int material) const
{
  const auto has_material = [material](const RigidBody& body) { return body.material == material; };
  const auto body = std::find_if(rigid_bodies.begin(), rigid_bodies.end(), has_material);
  return body == rigid_bodies.end() ? nullptr : &*body;
}

template struct Method<2>;
template struct Method<3>;

}  // namespace tamp::tasks
