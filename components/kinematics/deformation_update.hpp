#pragma once

#include <type_traits>
#include <variant>

#include "components/choice.hpp"
#include "components/kinematics/exact_update.hpp"
#include "components/kinematics/exponential_update.hpp"
#include "components/kinematics/first_order_update.hpp"

namespace tamp::components
{

/// All the updates there are, with the functions of ExactUpdate; one more is added here.
using DeformationUpdates = std::variant<ExactUpdate, FirstOrderUpdate, ExponentialUpdate>;

/// How the deformation of a step follows from g, dt times the velocity gradient; docs/explanation/method.md compares
/// them.
using DeformationUpdate = Choice<DeformationUpdates>;

/// Calls `visit(update)` with what an update is made of.
template <class Visit>
auto with_update(DeformationUpdate update, Visit&& visit)
{
  return update.visit([&]<class T>(std::type_identity<T>) { return visit(T()); });
}

}  // namespace tamp::components
