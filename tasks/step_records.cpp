#include "tasks/step_records.hpp"

namespace tamp::tasks
{

StepCause cause_of(double size, const SceneTime& time, const StepBound& bound, bool is_first, bool is_redone)
{
  if (is_redone) return StepCause::redone;
  if (size < time.multiplier * bound.size) return size < time.maximum_step ? StepCause::end : StepCause::maximum_step;
  if (is_first) return StepCause::start;
  return bound.setter.particle >= 0 ? StepCause::particle : StepCause::bodies;
}

void StepRecords::add(StepCause cause, const SetStep& step)
{
  ++by_cause[static_cast<std::size_t>(cause)];
  if (cause != StepCause::particle) return;
  ++by_material[static_cast<std::size_t>(step.setter.material)];
  if (first.step == 0) first = step;
  if (shortest.step == 0 || step.size < shortest.size) shortest = step;
  last = step;
}

}  // namespace tamp::tasks
