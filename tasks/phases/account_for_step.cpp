#include <fmt/format.h>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// Throws SimulationError if more stress updates have failed so far than the scene allows.
template <int D>
void check_failed_updates(const Method<D>& method, const StepTotals& before, const StepTotals& step)
{
  const std::size_t failures = before.updates.failures + step.updates.failures;
  const long allowed = method.scene.failed_updates_allowed;
  if (failures <= static_cast<std::size_t>(allowed)) return;
  const FailedUpdate& failed = step.failed;
  const SceneMaterial& material = method.materials[static_cast<std::size_t>(failed.material)];
  throw SimulationError(fmt::format("{}; {} stress updates have failed, {} are allowed", failed.reason(material.model),
                                    failures, allowed),
                        material.name, failed.particle, {failed.position.begin(), failed.position.begin() + D});
}

}  // namespace

template <int D>
runtime::TaskList account_for_step(const Method<D>& method)
{
  return {runtime::task("account for step")
              .over_ranks()
              .reads(step_totals.previous(), step_totals, grid_totals, energy_ledger.previous(),
                     load_totals.when(!method.pressed_materials.empty()),
                     body_force_work.when(method.scene.has_body_force()))
              .computes(energy_ledger, longest_step)
              .body([&method](const TaskContext&, auto data) {
                const StepTotals& step = data[step_totals];
                check_failed_updates(method, data[step_totals.previous()], step);
                EnergyLedger& ledger = data[energy_ledger];
                ledger = data[energy_ledger.previous()];
                ledger.add(step, data[grid_totals], data[body_force_work], data[load_totals],
                           method.deforms_by_other_velocities());
                data[longest_step] = step.stable_step;
              })};
}

template runtime::TaskList account_for_step(const Method<2>&);
template runtime::TaskList account_for_step(const Method<3>&);

}  // namespace tamp::tasks
