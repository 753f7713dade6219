#include "tasks/set_up/fill_bodies.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/particle_axes.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/deformed_start.hpp"

namespace tamp::tasks
{

using components::CarriedGradient;

namespace
{

template <int D>
runtime::Index cell_of(const runtime::Grid& grid, const Vector<D>& x)
{
  runtime::Index cell{0, 0, 0};
  for (std::size_t k = 0; k < D; ++k) {
    cell[k] = static_cast<int>(std::floor((x[static_cast<int>(k)] - grid.lower[k]) / grid.cell_size));
  }
  return cell;
}

/// The initial position of the particle that belongs to X [m].
template <int D>
Vector<D> initial_position(const components::BodyFunctions& functions, const Vector<D>& X)
{
  return functions.displacement ? Vector<D>(X + functions.displacement(in_space<D>(X)).template head<D>()) : X;
}

/// The gradient of a body's velocity where the particle of X starts [1/s]: that of its spin, or of the velocity that
/// its functions give it.
template <int D>
Matrix<D> velocity_gradient(const Scene& scene, const SceneBody& body, const Vector<D>& X)
{
  const components::BodyFunctions& functions = body.functions;
  if (!functions.velocity) {
    return cross_matrix(Eigen::Vector3d(body.angular_velocity.data())).template topLeftCorner<D, D>();
  }
  // Differences over this lose as little to round-off as to curvature.
  const double step = 1e-5 * scene.grid.cell_size;
  Matrix<D> by_reference;
  for (int k = 0; k < D; ++k) {
    const Vector<3> arm = in_space<D>(Vector<D>(step * Vector<D>::Unit(k)));
    const Vector<3> difference = functions.velocity(in_space<D>(X) + arm) - functions.velocity(in_space<D>(X) - arm);
    by_reference.col(k) = difference.template head<D>() / (2 * step);
  }
  if (!functions.deformation_gradient) return by_reference;
  const Matrix<3> F = functions.deformation_gradient(in_space<D>(X));
  return by_reference * F.template topLeftCorner<D, D>().inverse();
}

/// All nodes of the grid as one block, with layers around it that particles at open faces reach. Nothing lies there:
/// only weights may be asked for.
template <int D>
components::GridBlock<D> whole_grid(const runtime::Grid& grid)
{
  constexpr int n_around = 2;
  components::GridBlock<D> block;
  block.cell_size = grid.cell_size;
  std::ptrdiff_t stride = 1;
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    block.origin[axis] = grid.coordinate(axis, -n_around);
    block.n_nodes[k] = grid.n_cells[k] + 1 + 2 * n_around;
    block.strides[k] = std::exchange(stride, stride * block.n_nodes[k]);
  }
  return block;
}

}  // namespace

template <int D>
BodyParticles<D>::BodyParticles(const Scene& scene, const runtime::PatchLayout& layout)
    : scene_(scene), particles_(static_cast<std::size_t>(layout.size()), std::vector<Particles>(scene.materials.size()))
{
  std::int64_t id = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].initial_stress) settled_.emplace(b, SettledGround<D>(scene, scene.bodies[b]));
    Vector<D> sum = Vector<D>::Zero();
    double weight = 0;
    for (const components::Site<D>& site : particle_sites<D>(scene, scene.bodies[b])) {
      const Vector<D> x = initial_position<D>(scene.bodies[b].functions, site.place);
      const double part = scene.bodies[b].particles == ParticleLayout::cut ? site.volume : 1;
      sum += part * x;
      weight += part;
      const int patch = layout.patch_of_cell(cell_of<D>(scene.grid, x));
      auto& particles = particles_[static_cast<std::size_t>(patch)][static_cast<std::size_t>(scene.bodies[b].material)];
      particles.id.push_back(id++);
      particles.body.push_back(static_cast<std::int64_t>(b));
      particles.site.push_back(site);
      particles.position.push_back(x);
    }
    centres_.push_back(sum / weight);
  }
}

template <int D>
std::vector<std::size_t> BodyParticles<D>::counts() const
{
  std::vector<std::size_t> counts;
  counts.reserve(particles_.size() * scene_.materials.size());
  for (const auto& materials : particles_) {
    for (const Particles& particles : materials) counts.push_back(particles.id.size());
  }
  return counts;
}

template <int D>
Vector<D> BodyParticles<D>::rigid_velocity(int body, const Vector<D>& x) const
{
  const SceneBody& given = scene_.bodies[static_cast<std::size_t>(body)];
  const Eigen::Vector3d spin(given.angular_velocity.data());
  const Vector<D> arm = x - centres_[static_cast<std::size_t>(body)];
  return vector_of<D>(given.velocity) + spin.cross(in_space<D>(arm)).template head<D>();
}

template <int D>
Vector<D> BodyParticles<D>::initial_velocity(const Particles& particles, std::size_t p) const
{
  const auto body = static_cast<std::size_t>(particles.body[p]);
  const components::BodyFunctions& functions = scene_.bodies[body].functions;
  if (!functions.velocity) return rigid_velocity(static_cast<int>(body), particles.position[p]);
  return functions.velocity(in_space<D>(particles.site[p].place)).template head<D>();
}

template <int D>
Eigen::AlignedBox<double, D> BodyParticles<D>::velocities(int body) const
{
  const auto material = static_cast<std::size_t>(scene_.bodies[static_cast<std::size_t>(body)].material);
  Eigen::AlignedBox<double, D> span;
  for (const auto& materials : particles_) {
    const Particles& own = materials[material];
    for (std::size_t p = 0; p < own.id.size(); ++p) {
      if (own.body[p] != body) continue;
      span.extend(initial_velocity(own, p));
    }
  }
  return span;
}

template <int D>
double BodyParticles<D>::stored_energy() const
{
  double energy = 0;
  for (const auto& materials : particles_) {
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const Particles& own = materials[m];
      for (std::size_t p = 0; p < own.id.size(); ++p) {
        const SceneBody& body = scene_.bodies[static_cast<std::size_t>(own.body[p])];
        if (!body.functions.deformation_gradient) continue;
        energy += own.site[p].volume * deformed_start<D>(scene_, body, own.site[p].place).stored_energy;
      }
    }
  }
  return energy;
}

template <int D>
components::MassProperties BodyParticles<D>::mass_properties(int body) const
{
  const int material = scene_.bodies[static_cast<std::size_t>(body)].material;
  const auto lattice = lattice_of<D>(scene_, material);
  const double density = scene_.materials[static_cast<std::size_t>(material)].density;
  std::vector<Eigen::Vector3d> position;
  std::vector<double> mass;
  for (const auto& materials : particles_) {
    const Particles& own = materials[static_cast<std::size_t>(material)];
    std::transform(own.position.begin(), own.position.end(), std::back_inserter(position), in_space<D>);
    for (const components::Site<D>& site : own.site) mass.push_back(density * site.volume);
  }
  if (scene_.axisymmetric) {
    // Rings are about the axis.
    for (Eigen::Vector3d& x : position) x[0] = 0;
  }
  return components::mass_properties(mass, position, lattice.cell_size / lattice.n_per_axis, D == 2);
}

template <int D>
void BodyParticles<D>::store(runtime::Warehouse& warehouse) const
{
  for (const runtime::Patch& patch : warehouse.layout()) {
    if (!warehouse.is_local(patch)) continue;
    const auto& materials = particles_[static_cast<std::size_t>(patch.id)];
    for (std::size_t m = 0; m < materials.size(); ++m) store(materials[m], patch.id, static_cast<int>(m), warehouse);
  }
}

template <int D>
void BodyParticles<D>::store(const Particles& particles, int patch, int material, runtime::Warehouse& warehouse) const
{
  const std::size_t n = particles.id.size();
  warehouse.set_n_particles(patch, material, n);
  const auto state = [&](const auto& label) { return warehouse.state(label, patch, material); };
  const double density = scene_.materials[static_cast<std::size_t>(material)].density;
  const CarriedGradient carried = carried_gradient_of(scene_.transfer);
  for (std::size_t p = 0; p < n; ++p) {
    const auto number = static_cast<std::size_t>(particles.body[p]);
    const SceneBody& body = scene_.bodies[number];
    const components::Site<D>& site = particles.site[p];
    state(particle::id)[p] = particles.id[p];
    state(particle::body)[p] = particles.body[p];
    state(particle::position<D>)[p] = particles.position[p];
    state(particle::reference_position<D>)[p] = site.place;
    state(particle::velocity<D>)[p] = initial_velocity(particles, p);
    if (carried == CarriedGradient::gradient)
      state(particle::velocity_gradient<D>)[p] = velocity_gradient<D>(scene_, body, site.place);
    state(particle::deformation_gradient<D>)[p] = particle_axes<D>(scene_, body, site.place);
    if (scene_.axisymmetric) state(particle::hoop_stretch)[p] = particles.position[p][0] / site.place[0];
    state(particle::volume)[p] = site.volume;
    state(particle::mass)[p] = density * site.volume;
    if (body.functions.deformation_gradient) {
      const DeformedStart<D> start = deformed_start<D>(scene_, body, site.place);
      state(particle::deformation_gradient<D>)[p] = start.deformation_gradient;
      state(particle::volume)[p] = start.volume_ratio * site.volume;
      state(particle::stress<D>)[p] = start.stress;
    }
    if (!body.initial_stress) continue;
    settled_.at(number).check_at(particles.position[p]);
    const components::SettledStress settled = settled_.at(number).at(particles.position[p]);
    state(particle::stress<D>)[p] = settled.stress.template head<n_symmetric<D>>();
    const auto set_state = [&]<class Model>(const Model& model) {
      if constexpr (components::Settling<Model> && components::has_state<Model>) {
        state(particle::state<Model>)[p] = model.settled_state(settled);
      }
    };
    std::visit(set_state, scene_.materials[static_cast<std::size_t>(material)].model);
  }
  if (carried == CarriedGradient::moment) store_velocity_moments(particles, patch, material, warehouse);
}

template <int D>
void BodyParticles<D>::store_velocity_moments(const Particles& particles, int patch, int material,
                                              runtime::Warehouse& warehouse) const
{
  const auto moments = warehouse.state(particle::velocity_moment<D>, patch, material);
  const auto interpolation =
      components::Interpolation<D>::make(scene_.interpolator, scene_.particles_per_axis_of(material), scene_.plane());
  interpolation->second_moments(
      whole_grid<D>(scene_.grid),
      {particles.position, warehouse.state(particle::deformation_gradient<D>, patch, material)}, moments);
  for (std::size_t p = 0; p < moments.size(); ++p) {
    const SceneBody& body = scene_.bodies[static_cast<std::size_t>(particles.body[p])];
    moments[p] = velocity_gradient<D>(scene_, body, particles.site[p].place) * moments[p];
  }
}

template class BodyParticles<2>;
template class BodyParticles<3>;

}  // namespace tamp::tasks
