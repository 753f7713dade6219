#include "tasks/report.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/labels.hpp"

namespace tamp::tasks
{

using components::CapState;
using runtime::TaskContext;

namespace
{

template <int D>
auto report_task(const std::string& material, int group)
{
  return runtime::task("report: " + material)
      .over_patches_and_groups({group})
      .reads(particle::body.previous(), particle::mass.previous(), particle::position<D>.previous(),
             particle::reference_position<D>.previous(), particle::velocity<D>.previous(),
             particle::stress<D>.previous());
}

/// Per mass, of the loads that have one [J/kg].
template <class Interpolator, int D = Interpolator::dimension>
double work_function(const Method<Interpolator>& method, const Vector<D>& x)
{
  double work = method.gravity.dot(x);
  if constexpr (D == 3) {
    if (method.centrifuge && method.centrifuge->is_steady()) work += method.centrifuge->work_function(x);
  }
  return work;
}

/// A rigid body is known as a whole, and one patch tells of it; its particles as points would lack their own turning.
void report_rigid_motion(const TaskContext& at, const RigidBody& body, ParticleReport& report)
{
  if (at.patch.id != 0) return;
  report.kinetic += components::kinetic_energy(body.properties, body.state);
  report.bodies[static_cast<std::size_t>(body.body)] = sums_of(body.properties, body.state);
}

template <class Interpolator, class Data, int D = Interpolator::dimension>
void report_motion(const Method<Interpolator>& method, const TaskContext& at, const Data& data)
{
  const auto body = data[particle::body.previous()];
  const auto mass = data[particle::mass.previous()];
  const auto position = data[particle::position<D>.previous()];
  const auto reference = data[particle::reference_position<D>.previous()];
  const auto velocity = data[particle::velocity<D>.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  ParticleReport& report = data[particle_report];
  for (std::size_t p = 0; p < mass.size(); ++p) {
    report.gravity_work += mass[p] * work_function(method, position[p]);
    report.materials[static_cast<std::size_t>(at.group)].add(stress[p]);
  }
  if (const RigidBody* rigid = method.rigid_body(at.group)) {
    report_rigid_motion(at, *rigid, report);
    return;
  }
  for (std::size_t p = 0; p < mass.size(); ++p) {
    report.kinetic += 0.5 * mass[p] * velocity[p].squaredNorm();
    report.bodies[static_cast<std::size_t>(body[p])].add(mass[p], in_space<D>(position[p]), in_space<D>(reference[p]),
                                                         in_space<D>(velocity[p]));
  }
}

/// Of what is elastic, and so has no more to tell than its motion and stress.
template <class Interpolator, class Elastic>
runtime::TaskDeclaration report_of(const Method<Interpolator>& method, int group, const std::string& name,
                                   const Elastic&)
{
  return report_task<Interpolator::dimension>(name, group)
      .reduces(particle_report)
      .body([&method](const TaskContext& at, auto data) { report_motion(method, at, data); });
}

template <class Interpolator>
runtime::TaskDeclaration report_of(const Method<Interpolator>& method, int group, const std::string& name,
                                   const components::TabularCap& sand)
{
  return report_task<Interpolator::dimension>(name, group)
      .reads(particle::cap_state.previous())
      .reduces(particle_report)
      .body([&method, &sand](const TaskContext& at, auto data) {
        report_motion(method, at, data);
        MaterialPeaks& peaks = data[particle_report].materials[static_cast<std::size_t>(at.group)];
        for (const CapState& s : data[particle::cap_state.previous()]) peaks.add(sand, s);
      });
}

/// Where the noses of bodies are now, and how far "near" reaches.
class Noses
{
 public:
  Noses(const Scene& scene, const ParticleReport& report) : reach_(scene.output.near_nose)
  {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const SceneBody& body = scene.bodies[b];
      if (body.axis) places_.push_back(report.bodies[b].place_of(Eigen::Vector3d(body.axis->nose.data())));
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
template <int D>
auto nose_task(const std::string& material, int group)
{
  return runtime::task("report near noses: " + material)
      .over_patches_and_groups({group})
      .reads(particle_report, particle::position<D>.previous(), particle::stress<D>.previous());
}

template <class Interpolator>
runtime::TaskDeclaration report_near_noses(const Method<Interpolator>& method, int group)
{
  constexpr int D = Interpolator::dimension;
  const SceneMaterial& m = method.materials[static_cast<std::size_t>(group)];
  const auto* sand = std::get_if<components::TabularCap>(&m.model);
  if (sand == nullptr) {
    return nose_task<D>(m.name, group).reduces(nose_report).body([&method](const TaskContext& at, auto data) {
      const Noses noses(method.scene, data[particle_report]);
      const auto position = data[particle::position<D>.previous()];
      const auto stress = data[particle::stress<D>.previous()];
      MaterialPeaks& peaks = data[nose_report].materials[static_cast<std::size_t>(at.group)];
      for (std::size_t p = 0; p < position.size(); ++p) {
        if (noses.are_near(in_space<D>(position[p]))) peaks.add(stress[p]);
      }
    });
  }
  return nose_task<D>(m.name, group)
      .reads(particle::cap_state.previous())
      .reduces(nose_report)
      .body([&method, sand](const TaskContext& at, auto data) {
        const Noses noses(method.scene, data[particle_report]);
        const auto position = data[particle::position<D>.previous()];
        const auto stress = data[particle::stress<D>.previous()];
        const auto state = data[particle::cap_state.previous()];
        MaterialPeaks& peaks = data[nose_report].materials[static_cast<std::size_t>(at.group)];
        for (std::size_t p = 0; p < position.size(); ++p) {
          if (!noses.are_near(in_space<D>(position[p]))) continue;
          peaks.add(stress[p]);
          peaks.add(*sand, state[p]);
        }
      });
}

void combine(PeaksOfMaterials& into, const PeaksOfMaterials& other)
{
  for (std::size_t k = 0; k < into.size(); ++k) into[k].combine(other[k]);
}

}  // namespace

template <int Size>
void MaterialPeaks::add(const Eigen::Matrix<double, Size, 1>& stress)
{
  const Eigen::Matrix<double, Size, 1> s = deviator(stress);
  pressure = std::max(pressure, -trace(stress) / 3);
  q = std::max(q, std::sqrt(1.5 * double_dot(s, s)));
}

void MaterialPeaks::add(const components::TabularCap& sand, const CapState& state)
{
  cap = std::max(cap, sand.crush_pressure(state.plastic_volumetric));
  plastic_volumetric = std::max(plastic_volumetric, state.plastic_volumetric);
  least_plastic_volumetric = std::min(least_plastic_volumetric, state.plastic_volumetric);
}

void MaterialPeaks::combine(const MaterialPeaks& other)
{
  pressure = std::max(pressure, other.pressure);
  q = std::max(q, other.q);
  cap = std::max(cap, other.cap);
  plastic_volumetric = std::max(plastic_volumetric, other.plastic_volumetric);
  least_plastic_volumetric = std::min(least_plastic_volumetric, other.least_plastic_volumetric);
}

void ParticleReport::combine(const ParticleReport& other)
{
  kinetic += other.kinetic;
  gravity_work += other.gravity_work;
  for (std::size_t k = 0; k < max_entries; ++k) bodies[k].combine(other.bodies[k]);
  tasks::combine(materials, other.materials);
}

void NoseReport::combine(const NoseReport& other)
{
  tasks::combine(materials, other.materials);
}

Eigen::Vector3d ParticleReport::momentum() const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const BodySums& body : bodies) sum += body.momentum;
  return sum;
}

template <class Interpolator>
std::vector<runtime::TaskDeclaration> report_tasks(const Method<Interpolator>& method)
{
  std::vector<runtime::TaskDeclaration> tasks;
  for (int group = 0; group < static_cast<int>(method.materials.size()); ++group) {
    const SceneMaterial& m = method.materials[static_cast<std::size_t>(group)];
    tasks.push_back(std::visit([&](const auto& model) { return report_of(method, group, m.name, model); }, m.model));
  }
  if (method.scene.has_nose()) {
    for (int group = 0; group < static_cast<int>(method.materials.size()); ++group) {
      tasks.push_back(report_near_noses(method, group));
    }
  }
  return tasks;
}

template std::vector<runtime::TaskDeclaration> report_tasks(const Method<components::Gimp<2>>&);
template std::vector<runtime::TaskDeclaration> report_tasks(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
