#include "tools/scene/check_method.hpp"

namespace tamp::tools
{

void check_method(const JsonReader& reader, const tasks::Scene& scene)
{
  if (scene.interpolator == tasks::Interpolator::linear && scene.time.rule == tasks::StepRule::viscous) {
    reader.add_problem("interpolator", "\"linear\" with the time step's rule \"viscous\"",
                       "expected the rule \"published\", as a particle that hardly reaches a node would have no stable "
                       "step; or another interpolator");
  }
  if (scene.transfer == tasks::Transfer::apic && !components::has_second_moments(scene.interpolator)) {
    reader.add_problem("transfer",
                       "apic with an interpolator whose weights have no spread where a particle is on a node",
                       "expected another transfer, such as tpic, or another interpolator");
  }
}

}  // namespace tamp::tools
