#include "tasks/report.hpp"

#include <cmath>

#include "tasks/labels.hpp"

namespace tamp::tasks
{

using components::CapState;
using runtime::TaskContext;

namespace
{

template <int D>
Eigen::Vector3d in_space(const Vector<D>& v)
{
  Eigen::Vector3d padded = Eigen::Vector3d::Zero();
  padded.head<D>() = v;
  return padded;
}

template <int D>
void add_motion(double mass, const Vector<D>& x, const Vector<D>& reference, const Vector<D>& v, BodySums& body)
{
  body.mass += mass;
  body.momentum += in_space<D>(mass * v);
  body.position += in_space<D>(mass * x);
  body.reference_position += in_space<D>(mass * reference);
  body.aligned += mass * (reference[0] * x[0] + reference[1] * x[1]);
  body.turned += mass * (reference[0] * x[1] - reference[1] * x[0]);
}

template <int D>
void add_stress(const SymmetricTensor<D>& stress, MaterialPeaks& peaks)
{
  const SymmetricTensor<D> s = deviator(stress);
  peaks.pressure = std::max(peaks.pressure, -trace(stress) / 3);
  peaks.q = std::max(peaks.q, std::sqrt(1.5 * double_dot(s, s)));
}

template <int D>
auto report_task(const std::string& material, int group)
{
  return runtime::task("report: " + material)
      .over_patches_and_groups({group})
      .reads(particle::body.previous(), particle::mass.previous(), particle::position<D>.previous(),
             particle::reference_position<D>.previous(), particle::velocity<D>.previous(),
             particle::stress<D>.previous());
}

template <class Interpolator, int D = Interpolator::dimension>
void report_motion(const Method<Interpolator>& method, int group, std::span<const std::int64_t> body,
                   std::span<const double> mass, std::span<const Vector<D>> position,
                   std::span<const Vector<D>> reference, std::span<const Vector<D>> velocity,
                   std::span<const SymmetricTensor<D>> stress, ParticleReport& report)
{
  for (std::size_t p = 0; p < mass.size(); ++p) {
    report.kinetic += 0.5 * mass[p] * velocity[p].squaredNorm();
    report.gravity_work += mass[p] * method.gravity.dot(position[p]);
    add_motion<D>(mass[p], position[p], reference[p], velocity[p], report.bodies[static_cast<std::size_t>(body[p])]);
    add_stress<D>(stress[p], report.materials[static_cast<std::size_t>(group)]);
  }
}

/// Of what is elastic, and so has no more to tell than its motion and stress.
template <class Interpolator, class Elastic>
runtime::TaskDeclaration report_of(const Method<Interpolator>& method, int group, const std::string& name,
                                   const Elastic&)
{
  return report_task<Interpolator::dimension>(name, group)
      .reduces(particle_report)
      .body([&method](const TaskContext& at, auto body, auto mass, auto position, auto reference, auto velocity,
                      auto stress, ParticleReport& report) {
        report_motion(method, at.group, body, mass, position, reference, velocity, stress, report);
      });
}

template <class Interpolator>
runtime::TaskDeclaration report_of(const Method<Interpolator>& method, int group, const std::string& name,
                                   const components::TabularCap& sand)
{
  return report_task<Interpolator::dimension>(name, group)
      .reads(particle::cap_state.previous())
      .reduces(particle_report)
      .body([&method, &sand](const TaskContext& at, auto body, auto mass, auto position, auto reference, auto velocity,
                             auto stress, std::span<const CapState> state, ParticleReport& report) {
        report_motion(method, at.group, body, mass, position, reference, velocity, stress, report);
        MaterialPeaks& peaks = report.materials[static_cast<std::size_t>(at.group)];
        for (const CapState& s : state) {
          peaks.cap = std::max(peaks.cap, sand.crush_pressure(s.plastic_volumetric));
          peaks.plastic_volumetric = std::max(peaks.plastic_volumetric, s.plastic_volumetric);
          peaks.least_plastic_volumetric = std::min(peaks.least_plastic_volumetric, s.plastic_volumetric);
        }
      });
}

}  // namespace

void BodySums::combine(const BodySums& other)
{
  mass += other.mass;
  momentum += other.momentum;
  position += other.position;
  reference_position += other.reference_position;
  aligned += other.aligned;
  turned += other.turned;
}

double BodySums::tilt() const
{
  const Eigen::Vector3d& x = position;
  const Eigen::Vector3d& r = reference_position;
  const double cosine = aligned - (r[0] * x[0] + r[1] * x[1]) / mass;
  const double sine = turned - (r[0] * x[1] - r[1] * x[0]) / mass;
  return std::atan2(sine, cosine);
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
  for (std::size_t k = 0; k < max_entries; ++k) {
    bodies[k].combine(other.bodies[k]);
    materials[k].combine(other.materials[k]);
  }
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
  return tasks;
}

template std::vector<runtime::TaskDeclaration> report_tasks(const Method<components::Gimp<2>>&);
template std::vector<runtime::TaskDeclaration> report_tasks(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
