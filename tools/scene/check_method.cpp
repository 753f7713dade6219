#include "tools/scene/check_method.hpp"

#include <fmt/format.h>

#include <variant>

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

void check_stress_timing(const JsonReader& reader, const tasks::Scene& scene)
{
  if (scene.stress_timing != tasks::StressTiming::usf || scene.transfer != tasks::Transfer::affine) return;
  for (const tasks::SceneMaterial& material : scene.materials) {
    const auto may_come_apart = [](const auto& model) {
      if constexpr (requires { model.may_come_apart(); }) return model.may_come_apart();
      return false;
    };
    if (!std::visit(may_come_apart, material.model)) continue;
    reader.add_problem("stress_timing",
                       fmt::format("\"usf\" with the transfer affine and sand that comes apart, \"{}\"", material.name),
                       "expected usl or musl, as sand that is apart has to forget the gradient of its velocity, which "
                       "with usf it only gets after its stress; or another transfer");
  }
}

}  // namespace tamp::tools
