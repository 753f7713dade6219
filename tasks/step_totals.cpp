#include "tasks/step_totals.hpp"

#include <fmt/format.h>

namespace tamp::tasks
{

namespace
{

template <class Model>
std::string state_in_words(const Model&, std::span<const double> values)
{
  std::string words;
  std::size_t k = 0;
  for (const auto& column : components::state_columns<Model>()) {
    const bool has_unit = !column.unit.empty() && column.unit != "-";
    words += fmt::format(", {} {:.6g}{}{}", column.name, values[k++], has_unit ? " " : "", has_unit ? column.unit : "");
  }
  return words;
}

}  // namespace

const char* to_string(MotionFault fault)
{
  switch (fault) {
    case MotionFault::inside_out:
      return "a particle is turned inside out";
    case MotionFault::turned_too_far:
      return "a particle turns or shears by more than half a turn in one step";
    case MotionFault::not_finite:
      return "stress or velocity is not finite";
  }
  return "";
}

std::string FailedUpdate::reason(const components::MaterialModel& model) const
{
  const std::string words = std::visit([&](const auto& m) { return state_in_words(m, state); }, model);
  return fmt::format(
      "{}; its stress stays p = {:.6g} Pa, q = {:.6g} Pa, the strain increment was {:.3g} of volume and {:.3g} of "
      "shape (compression positive){}",
      to_string(fault), pressure, q, volumetric_increment, deviatoric_increment, words);
}

}  // namespace tamp::tasks
