#pragma once

#include <stdexcept>

#include "components/kinematics/exact_update.hpp"
#include "components/kinematics/exponential_update.hpp"
#include "components/kinematics/first_order_update.hpp"

namespace tamp::components
{

/// How the deformation of a step follows from g, dt times the velocity gradient; docs/method.md compares them.
enum class DeformationUpdate { exact, first_order, exponential };

/// Calls `visit(update)` with what an update is made of: the one list of all updates.
template <class Visit>
auto with_update(DeformationUpdate update, Visit&& visit)
{
  switch (update) {
    case DeformationUpdate::exact:
      return visit(ExactUpdate());
    case DeformationUpdate::first_order:
      return visit(FirstOrderUpdate());
    case DeformationUpdate::exponential:
      return visit(ExponentialUpdate());
  }
  throw std::logic_error("unknown deformation update");
}

}  // namespace tamp::components
