#include "tasks/report/report.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/labels.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// A rigid body is known as a whole, and one patch reports it; its particles as points would lack their own turning.
void report_rigid_motion(const TaskContext& at, const RigidBody& body, const components::RigidState& state,
                         ParticleReport& report)
{
  if (at.patch.id != 0) return;
  const double kinetic = components::kinetic_energy(body.properties, state);
  report.kinetic += kinetic;
  report.sum_of_momenta += std::sqrt(2 * body.properties.mass * kinetic);
  report.bodies[static_cast<std::size_t>(body.body)] = sums_of(body.properties, state);
}

/// Where a particle would be if no periodic end had put it back: there its way and the work of gravity go on.
template <int D>
Vector<D> travelled_to(const runtime::Grid& grid, const Vector<D>& position, const runtime::Index& laps)
{
  Vector<D> x = position;
  for (std::size_t k = 0; k < std::size_t{D}; ++k) x[static_cast<Eigen::Index>(k)] += laps[k] * grid.length(k);
  return x;
}

/// Where each particle is, or would be: the place of p is `places(p)`.
template <int D, class Data>
auto places_of(const TaskContext& at, const Data& data)
{
  const auto position = data[particle::position<D>.previous()];
  return [&at, position, laps = data[particle::laps.previous()]](std::size_t p) {
    return laps.empty() ? position[p] : travelled_to<D>(at.layout.grid(), position[p], laps[p]);
  };
}

template <int D, class Data>
void report_errors(const Method<D>& method, const TaskContext& at, const Data& data)
{
  const auto body = data[particle::body.previous()];
  const auto mass = data[particle::mass.previous()];
  const auto reference = data[particle::reference_position<D>.previous()];
  ParticleReport& report = data[particle_report];
  const auto has_exact = [](const SceneBody& of_scene) {
    return static_cast<bool>(of_scene.functions.exact_displacement);
  };
  if (std::none_of(method.scene.bodies.begin(), method.scene.bodies.end(), has_exact)) return;
  const auto place = places_of<D>(at, data);
  for (std::size_t p = 0; p < mass.size(); ++p) {
    const auto b = static_cast<std::size_t>(body[p]);
    const auto& exact = method.scene.bodies[b].functions.exact_displacement;
    if (!exact) continue;
    const Vector<D> expected = exact(in_space<D>(reference[p]), at.step.time).template head<D>();
    report.displacement_errors[b].add(mass[p], (place(p) - reference[p] - expected).norm());
  }
}

template <int D, class Data>
void report_motion(const Method<D>& method, const TaskContext& at, const Data& data)
{
  const auto body = data[particle::body.previous()];
  const auto mass = data[particle::mass.previous()];
  const auto reference = data[particle::reference_position<D>.previous()];
  const auto velocity = data[particle::velocity<D>.previous()];
  ParticleReport& report = data[particle_report];
  const auto place = places_of<D>(at, data);
  double gravity_work = 0, at_end = 0, kinetic = 0, sum_of_momenta = 0;
  for (std::size_t p = 0; p < mass.size(); ++p) {
    const Vector<D> now = place(p), half_step_before = now - 0.5 * at.step.previous_size * velocity[p];
    const double work = method.work_function(now);
    gravity_work += mass[p] * work;
    at_end += mass[p] * (work - method.work_function(half_step_before));
  }
  report.gravity_work += gravity_work;
  report.gravity_work_at_end += at_end;
  if (const RigidBody* rigid = method.rigid_body(at.group)) {
    report_rigid_motion(at, *rigid, data[rigid_states.previous()].of(*rigid), report);
    return;
  }
  for (std::size_t p = 0; p < mass.size(); ++p) {
    kinetic += 0.5 * mass[p] * velocity[p].squaredNorm();
    sum_of_momenta += mass[p] * velocity[p].norm();
    Vector<D> x = place(p), start = reference[p];
    // The centre of a ring is on the axis.
    if (method.axisymmetric) x[0] = start[0] = 0;
    report.bodies[static_cast<std::size_t>(body[p])].template add<D>(mass[p], x, start, velocity[p]);
  }
  report.kinetic += kinetic;
  report.sum_of_momenta += sum_of_momenta;
}

/// Adds `n` particles of a patch, of which number i is `at(i)`, to the peaks of their material.
template <int D, class Model, class Data, class At>
void add_peaks(const Model& model, const Data& data, std::size_t n, const At& at, MaterialPeaks& peaks)
{
  const auto stress = data[particle::stress<D>.previous()];
  std::vector<components::Invariants> of_stress(n);
  for (std::size_t i = 0; i < n; ++i) of_stress[i] = components::invariants(stress[at(i)]);
  peaks.add(of_stress);
  if constexpr (components::has_state<Model>) {
    const auto states = data[particle::state<Model>.previous()];
    const auto state = [&](std::size_t i) -> const typename Model::State& { return states[at(i)]; };
    peaks.add(model, state, of_stress);
  }
}

/// The task with the state of a model, if there is one, and a body.
template <class Model, class Task, class Body>
runtime::TaskDeclaration with_state(Task task, const Body& body)
{
  if constexpr (components::has_state<Model>) {
    return std::move(task).reads(particle::state<Model>.previous()).body(body);
  } else {
    return std::move(task).body(body);
  }
}

template <int D, class Model>
runtime::TaskDeclaration report_of(const Method<D>& method, int material, const Model& model)
{
  // A rigid body is reported once, on a patch that its particles may not be on.
  const bool is_rigid = method.rigid_body(material) != nullptr;
  auto task = runtime::task("report: " + method.materials[static_cast<std::size_t>(material)].name)
                  .over_patches_and_groups({material})
                  .sparse(is_rigid ? runtime::Sparsity::none : runtime::Sparsity::no_particles)
                  .reads(rigid_states.previous(), particle::body.previous(), particle::mass.previous(),
                         particle::position<D>.previous(), particle::reference_position<D>.previous(),
                         particle::velocity<D>.previous(), particle::stress<D>.previous(),
                         particle::laps.previous().when(method.scene.is_periodic()))
                  .reduces(particle_report);
  const auto body = [&method, &model](const TaskContext& at, auto data) {
    report_motion(method, at, data);
    report_errors(method, at, data);
    const auto each = [](std::size_t i) { return i; };
    add_peaks<D>(model, data, data[particle::mass.previous()].size(), each,
                 data[particle_report].materials[static_cast<std::size_t>(at.group)]);
  };
  return with_state<Model>(std::move(task), body);
}

/// Where the noses of bodies are now, and how far "near" reaches.
class Noses
{
 public:
  Noses(const Scene& scene, const ParticleReport& report) : reach_(scene.output.near_nose)
  {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const SceneBody& body = scene.bodies[b];
      if (body.axis) places_.push_back(report.bodies[b].position_of(Eigen::Vector3d(body.axis->nose.data())));
    }
  }

  bool are_near(const Eigen::Vector3d& x) const
  {
    return std::any_of(places_.begin(), places_.end(),
                       [&](const Eigen::Vector3d& nose) { return (x - nose).norm() <= reach_; });
  }

 private:
  double reach_;
  std::vector<Eigen::Vector3d> places_;
};

/// Waits for the report of the bodies, which tells where their noses are.
template <int D, class Model>
runtime::TaskDeclaration report_at_noses(const Method<D>& method, int material, const Model& model)
{
  auto task = runtime::task("report near noses: " + method.materials[static_cast<std::size_t>(material)].name)
                  .over_patches_and_groups({material})
                  .sparse()
                  .reads(particle_report, particle::position<D>.previous(), particle::stress<D>.previous())
                  .reduces(nose_report);
  return with_state<Model>(std::move(task), [&method, &model](const TaskContext& at, auto data) {
    const Noses noses(method.scene, data[particle_report]);
    const auto position = data[particle::position<D>.previous()];
    std::vector<std::size_t> near;
    for (std::size_t p = 0; p < position.size(); ++p) {
      if (noses.are_near(in_space<D>(position[p]))) near.push_back(p);
    }
    add_peaks<D>(
        model, data, near.size(), [&](std::size_t i) { return near[i]; },
        data[nose_report].materials[static_cast<std::size_t>(at.group)]);
  });
}

}  // namespace

void MaterialPeaks::add(std::span<const components::Invariants> stress)
{
  components::Invariants greatest{pressure, 0};
  for (const components::Invariants& of_particle : stress) {
    greatest.pressure = std::max(greatest.pressure, of_particle.pressure);
    greatest.j2 = std::max(greatest.j2, of_particle.j2);
  }
  pressure = greatest.pressure;
  q = std::max(q, greatest.q());
}

/// A column after the other, so that what a column is need be found only once.
template <class Model, class State>
void MaterialPeaks::add(const Model& model, const State& state, std::span<const components::Invariants> stress)
{
  std::size_t k = 0;
  for (const auto& [column, greatest] : components::state_extremes<Model>()) {
    const auto value = components::state_columns<Model>()[column].value;
    const double sign = greatest ? 1 : -1;
    double extreme = extremes[k];
    for (std::size_t i = 0; i < stress.size(); ++i) {
      extreme = std::max(extreme, sign * value(model, state(i), stress[i]));
    }
    extremes[k++] = extreme;
  }
}

void DisplacementError::add(double particle_mass, double error)
{
  mass += particle_mass;
  mass_times_square += particle_mass * error * error;
  greatest = std::max(greatest, error);
}

double DisplacementError::rms() const
{
  return std::sqrt(mass_times_square / mass);
}

Eigen::Vector3d ParticleReport::momentum() const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const BodySums& body : bodies) sum += body.momentum;
  return sum;
}

template <int D>
std::vector<runtime::TaskDeclaration> report_tasks(const Method<D>& method)
{
  std::vector<runtime::TaskDeclaration> tasks;
  const auto add_for_all = [&](const auto& report) {
    for (int material = 0; material < static_cast<int>(method.materials.size()); ++material) {
      const MaterialModel& any = method.materials[static_cast<std::size_t>(material)].model;
      tasks.push_back(std::visit([&](const auto& model) { return report(material, model); }, any));
    }
  };
  add_for_all([&](int material, const auto& model) { return report_of(method, material, model); });
  if (method.scene.has_nose()) {
    add_for_all([&](int material, const auto& model) { return report_at_noses(method, material, model); });
  }
  return tasks;
}

template std::vector<runtime::TaskDeclaration> report_tasks(const Method<2>&);
template std::vector<runtime::TaskDeclaration> report_tasks(const Method<3>&);

}  // namespace tamp::tasks
