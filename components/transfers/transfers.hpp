#pragma once

#include <type_traits>
#include <variant>

#include "components/choice.hpp"
#include "components/transfers/apic.hpp"
#include "components/transfers/blend.hpp"
#include "components/transfers/flip.hpp"
#include "components/transfers/fmpm.hpp"
#include "components/transfers/pic.hpp"
#include "components/transfers/tflip.hpp"
#include "components/transfers/tpic.hpp"
#include "components/transfers/xpic.hpp"

namespace tamp::components
{

/// All the transfers there are, see transfer.hpp; one more is added here.
using Transfers = std::variant<Flip, Pic, Blend, Tflip, Apic, Tpic, Xpic, Fmpm>;

/// How velocities go between particles and grid; docs/explanation/method.md says what each is for.
using Transfer = Choice<Transfers>;

/// Calls `visit(transfer)` with what `choice` names.
template <class Visit>
auto with_transfer(Transfer choice, const TransferNumbers& numbers, Visit&& visit)
{
  return choice.visit([&]<class T>(std::type_identity<T>) {
    if constexpr (requires { T(numbers); }) {
      return visit(T(numbers));
    } else {
      return visit(T());
    }
  });
}

inline CarriedGradient carried_gradient_of(Transfer choice)
{
  return choice.visit([]<class T>(std::type_identity<T>) { return T::carried_gradient; });
}

/// Whether particles bring gradients beside velocities of their own, which no node slows.
inline bool brings_own_gradients(Transfer choice)
{
  return choice.visit(
      []<class T>(std::type_identity<T>) { return T::carried_gradient == CarriedGradient::gradient && !T::filters; });
}

}  // namespace tamp::components
