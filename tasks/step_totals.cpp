#include "tasks/step_totals.hpp"

#include <fmt/format.h>

namespace tamp::tasks
{

std::string FailedUpdate::reason() const
{
  return fmt::format(
      "{}; its stress stays p = {:.6g} Pa, q = {:.6g} Pa, its elastic and plastic volumetric strain {:.6g} and {:.6g} "
      "(compression positive), the strain increment was {:.3g} of volume and {:.3g} of shape, and {} of its updates "
      "have failed",
      to_string(fault), pressure, q, state.elastic_volumetric, state.plastic_volumetric, volumetric_increment,
      deviatoric_increment, state.n_failures);
}

}  // namespace tamp::tasks
