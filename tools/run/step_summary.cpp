#include "tools/run/step_summary.hpp"

#include <vector>

namespace tamp::tools
{

namespace
{

nlohmann::ordered_json step_with_setter(const tasks::SetStep& step, const tasks::Scene& scene)
{
  if (step.step == 0) return nullptr;
  const tasks::StepSetter& setter = step.setter;
  return {{"step", step.step},
          {"time_s", step.time},
          {"size_s", step.size},
          {"particle", setter.particle},
          {"material", scene.materials[static_cast<std::size_t>(setter.material)].name},
          {"position_m", std::vector(setter.position.begin(), setter.position.begin() + scene.grid.dimension)},
          {"J", setter.volume_ratio},
          {"pressure_Pa", setter.pressure},
          {"wave_speed_m_per_s", setter.wave_speed}};
}

nlohmann::ordered_json step_counts(const tasks::StepRecords& records, const tasks::Scene& scene)
{
  using tasks::StepCause;
  nlohmann::ordered_json particles = nlohmann::ordered_json::object();
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (!scene.is_rigid(static_cast<int>(m))) particles[scene.materials[m].name] = records.by_material[m];
  }
  return {{"particles", particles},
          {"bodies", records.count(StepCause::bodies)},
          {"start", records.count(StepCause::start)},
          {"maximum_step", records.count(StepCause::maximum_step)},
          {"redone", records.count(StepCause::redone)},
          {"end", records.count(StepCause::end)}};
}

}  // namespace

nlohmann::ordered_json step_summary(const tasks::Simulation& simulation)
{
  const tasks::Scene& scene = simulation.scene();
  const tasks::StepRecords& records = simulation.step_records();
  return {{"first", step_with_setter(records.first, scene)},
          {"shortest", step_with_setter(records.shortest, scene)},
          {"last", step_with_setter(records.last, scene)},
          {"set_by", step_counts(records, scene)}};
}

}  // namespace tamp::tools
