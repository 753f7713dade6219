#include "tasks/step_refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace tamp::tasks
{

namespace
{

SimulationError error_at(const Scene& scene, const std::string& reason, const ParticlePlace& place)
{
  return {reason,
          scene.materials[static_cast<std::size_t>(place.material)].name,
          place.particle,
          {place.position.begin(), place.position.begin() + scene.grid.dimension}};
}

SimulationError error_of(const Scene& scene, const FailedUpdate& failed, std::size_t n_failures)
{
  const SceneMaterial& material = scene.materials[static_cast<std::size_t>(failed.material)];
  return error_at(scene,
                  fmt::format("{}; {} stress updates have failed, {} are allowed", failed.reason(material.model),
                              n_failures, scene.failed_updates_allowed),
                  failed);
}

}  // namespace

std::optional<SimulationError> refusal(const Scene& scene, const StepTotals& before, const StepTotals& step,
                                       double size)
{
  const BadMotion& bad = step.bad_motion;
  if (bad.particle >= 0) return error_at(scene, to_string(bad.fault), bad);
  const std::size_t n_failures = before.updates.failures + step.updates.failures;
  if (n_failures > static_cast<std::size_t>(scene.failed_updates_allowed)) {
    return error_of(scene, step.failed, n_failures);
  }
  // Whoever asks for steps beyond their bound gets them: only what matter adds to that by growing stiffer is refused.
  const double courant_number = size * step.greatest_wave_speed / scene.grid.cell_size;
  if (courant_number <= scene.limits.courant_number * std::max(1.0, scene.time.multiplier)) return {};
  return SimulationError(fmt::format("matter became too stiff for the step of {:.3g} s while it was taken: by its end "
                                     "waves of {:.4g} m/s cross {:.3g} cells in it",
                                     size, step.greatest_wave_speed, courant_number),
                         "", -1, {});
}

}  // namespace tamp::tasks
