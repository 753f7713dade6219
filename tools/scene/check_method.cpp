#include "tools/scene/check_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace tamp::tools
{

void check_method(const JsonReader& reader, const tasks::Scene& scene)
{
  const bool has_stable_step = components::with_shape<1>(
      scene.interpolator, 1, [](const auto& shape) { return std::isfinite(shape.greatest_stiffness_along_axis()); });
  if (!has_stable_step && scene.time.rule == tasks::StepRule::viscous) {
    reader.add_problem("interpolator",
                       fmt::format("\"{}\" with the time step's rule \"viscous\"", scene.interpolator.word()),
                       "expected the rule \"published\", as a particle that hardly reaches a node would have no stable "
                       "step; or another interpolator");
  }
  const bool divides_by_moments = carried_gradient_of(scene.transfer) == components::CarriedGradient::moment;
  if (divides_by_moments && !components::has_second_moments(scene.interpolator)) {
    reader.add_problem("transfer",
                       fmt::format("{} with an interpolator whose weights have no spread where a particle is on a node",
                                   scene.transfer.word()),
                       "expected another transfer, such as tpic, or another interpolator");
  }
}

void check_stress_timing(const JsonReader& reader, const tasks::Scene& scene)
{
  if (scene.stress_timing != tasks::StressTiming::usf || !components::brings_own_gradients(scene.transfer)) return;
  for (const tasks::SceneMaterial& material : scene.materials) {
    const auto may_separate = [](const auto& model) {
      if constexpr (requires { model.may_separate(); }) return model.may_separate();
      return false;
    };
    if (!std::visit(may_separate, material.model)) continue;
    reader.add_problem("stress_timing",
                       fmt::format("\"usf\" with the transfer {} and sand that separates, \"{}\"",
                                   scene.transfer.word(), material.name),
                       "expected usl or musl, as sand that is apart has to forget the gradient of its velocity, which "
                       "with usf it only gets after its stress; or another transfer");
  }
}

void check_contact_of_transfer(const JsonReader& reader, const tasks::Scene& scene)
{
  const bool passes_from_end = components::with_transfer(scene.transfer, scene.transfer_numbers, [](const auto& t) {
    return t.passes == components::Passes::from_end && t.n_passes() > 0;
  });
  if (!passes_from_end) return;
  const std::string fmpm = fmt::format("{} of order {}", scene.transfer.word(), scene.transfer_numbers.filter_order);
  if (scene.has_wall_to_leave()) {
    reader.add_problem("transfer", fmpm + " with a wall that can be left",
                       "expected another transfer, as particles would gain energy where the wall stops nodes");
  }
  const int n_materials = static_cast<int>(scene.materials.size());
  const auto n_where_touched = std::count_if(scene.contacts.begin(), scene.contacts.end(), [](const auto& contact) {
    return !components::acts_apart(contact.normal);
  });
  if (n_where_touched == n_materials * (n_materials - 1) / 2) return;
  reader.add_problem("transfer", fmpm + " with materials that do not meet by regression",
                     "expected the normal \"regression\" for every pair of materials, as particles gain energy where "
                     "contact acts a cell away; or another transfer");
}

}  // namespace tamp::tools
