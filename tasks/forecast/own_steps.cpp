#include "tasks/forecast/own_steps.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "components/loads/time_step.hpp"
#include "tasks/set_up/initial_moduli.hpp"

namespace tamp::tasks
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sand and soil, whose moduli stay as they are while they lighten; matter that may separate has no waves then.
bool may_be_loose(const SceneMaterial& material)
{
  return std::visit(
      []<class Model>(const Model& model) {
        if constexpr (requires { model.may_separate(); }) return !model.may_separate();
        return components::has_state<Model>;
      },
      material.model);
}

/// The greatest volume of a particle of each material, over that of the undeformed one.
std::vector<double> greatest_volume_ratios(Simulation& trial)
{
  const runtime::FieldCopy copy = trial.fields({.names = std::vector<std::string>{"J"}}, false);
  std::vector<double> greatest;
  for (const runtime::ParticleBlock& block : copy.particles) {
    greatest.push_back(1);
    for (const runtime::Column& column : block.columns) {
      if (column.name != "J") continue;
      for (const double ratio : std::get<std::span<const double>>(column.values)) {
        greatest.back() = std::max(greatest.back(), ratio);
      }
    }
  }
  return greatest;
}

/// The bound for sand that is thrown up, at an edge of the rest, at rest: its modulus stays that of unstrained sand as
/// its density falls by J.
double bound_of_loose(const Scene& scene, const SceneMaterial& material, double volume_ratio)
{
  constexpr double stiffness_at_edge = 5;  // see docs/explanation/method.md
  const components::TangentModuli moduli = initial_moduli(material);
  const double density = material.density / volume_ratio, h = scene.grid.cell_size;
  if (scene.time.rule == components::StepRule::published) {
    return h / components::wave_speed(moduli.bulk_modulus, moduli.shear_modulus, density);
  }
  const auto viscosity = scene.artificial_viscosity.value_or(components::ArtificialViscosity{0, 0});
  const auto bound = [&]<int D>(std::integral_constant<int, D>) {
    const components::StiffParticle<D> particle{density, moduli.bulk_modulus, moduli.shear_modulus, Vector<D>::Zero(),
                                                0,       stiffness_at_edge};
    return components::viscous_time_step<D>(h, particle, viscosity);
  };
  return scene.grid.dimension == 2 ? bound(std::integral_constant<int, 2>()) : bound(std::integral_constant<int, 3>());
}

}  // namespace

OwnSteps::OwnSteps(const Scene& scene, int factor) : scene_(scene), factor_(factor) {}

void OwnSteps::before(Simulation& trial)
{
  constexpr long looked_at_every = 10;
  if (trial.n_steps() % looked_at_every == 0) loosest_ = loosest_bound(trial);
  bound_ = std::min(trial.stable_step() / factor_, loosest_);
}

void OwnSteps::after(const Simulation& trial)
{
  count_ += trial.last_step_size() / std::min(scene_.time.multiplier * bound_, scene_.time.maximum_step);
}

/// Sand that is thrown up and stays together gets faster waves as it gets lighter, and in the end sets the step. Two
/// particles that part start one spacing from each other and end as far as they are thrown, on any cells: the loosest
/// of the trial is opened as many times further on finer cells as its neighbours start closer.
double OwnSteps::loosest_bound(Simulation& trial) const
{
  if (std::ranges::none_of(scene_.materials, may_be_loose)) return infinity;
  // From its densest to its loosest packing sand dilates by a third: beyond, grains do not touch.
  constexpr double thrown_from = 4.0 / 3.0;
  const std::vector<double> greatest = greatest_volume_ratios(trial);
  double bound = infinity;
  for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
    if (scene_.is_rigid(static_cast<int>(m)) || !may_be_loose(scene_.materials[m]) || !(greatest[m] > thrown_from)) {
      continue;
    }
    bound = std::min(bound, bound_of_loose(scene_, scene_.materials[m], greatest[m] * factor_));
  }
  return bound;
}

}  // namespace tamp::tasks
