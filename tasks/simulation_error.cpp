#include "tasks/simulation_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tamp::tasks
{

namespace
{

std::string message_of(const std::string& reason, const std::string& material, std::int64_t particle,
                       const std::vector<double>& position)
{
  if (particle < 0) return reason;
  return fmt::format("{}: particle {} of material '{}' at ({:.6g}) m", reason, particle, material,
                     fmt::join(position, ", "));
}

}  // namespace

SimulationError::SimulationError(const std::string& reason, std::string material_, std::int64_t particle_,
                                 std::vector<double> position_)
    : runtime::StepError(message_of(reason, material_, particle_, position_)),
      material(std::move(material_)),
      particle(particle_),
      position(std::move(position_))
{
}

}  // namespace tamp::tasks
