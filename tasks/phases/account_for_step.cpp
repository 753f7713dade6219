#include "runtime/graph/step_verdict.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/step_refusal.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

template <int D>
runtime::TaskList account_for_step(const Method<D>& method)
{
  return {runtime::task("account for step")
              .over_ranks()
              .reads(step_totals.previous(), step_totals, grid_totals, energy_ledger.previous(),
                     solid_totals.when(!method.touch_solids.empty()),
                     load_totals.when(!method.pressed_materials.empty()),
                     body_force_work.when(method.scene.has_body_force()))
              .computes(energy_ledger, longest_step, runtime::step_verdict)
              .body([&method](const TaskContext& at, auto data) {
                StepTotals step = data[step_totals];
                runtime::combine(step, data[solid_totals]);
                data[runtime::step_verdict].refused =
                    refusal(method.scene, data[step_totals.previous()], step, at.step.size).has_value();
                EnergyLedger& ledger = data[energy_ledger];
                ledger = data[energy_ledger.previous()];
                ledger.add(step, data[grid_totals], data[body_force_work], data[load_totals],
                           method.deforms_by_other_velocities());
                data[longest_step] = step.next_bound();
              })};
}

template runtime::TaskList account_for_step(const Method<2>&);
template runtime::TaskList account_for_step(const Method<3>&);

}  // namespace tamp::tasks
