#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/shapes/transfer.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Where passes u_j = (1 - S+ S) u_{j-1} of nodes -> particles -> nodes begin, S+ being how velocities come to the
/// nodes: nowhere, at the nodes' velocities of the start of the step, or at those that contact and walls have left.
enum class Passes { none, from_start, from_end };

/// The numbers that some transfers have; each of those names its own as `own_key`.
struct TransferNumbers {
  double flip_part = 0.99;
  int filter_order = 2;

  static constexpr std::array<Parameter<TransferNumbers>, 2> parameters();
};

constexpr std::array<Parameter<TransferNumbers>, 2> TransferNumbers::parameters()
{
  return {{{"flip_part",
            "",
            {.lower = 0, .upper = 1},
            &TransferNumbers::flip_part,
            "with `\"blend\"` only: the part of `\"flip\"`, from 0 to 1; the rest is `\"pic\"`",
            true},
           {"filter_order",
            "",
            {.lower = 1, .upper = 100},
            &TransferNumbers::filter_order,
            "with `\"xpic\"` and `\"fmpm\"` only: their order; 1 is `\"pic\"`, and each one more takes another "
            "pass over the particles",
            true}}};
}

/// Members of every transfer beside `word`, its name in scenes, and `meaning`, how velocities go, for people; where it
/// has numbers it is made from a TransferNumbers. These are the values for most:
///
///  - `carried_gradient`, that of its particles;
///  - `filters`, whether the nodes' part of their velocity is all that particles keep, in which walls and their images
///    then have a say;
///  - `passes` and `n_passes()`, of nodes -> particles -> nodes;
///  - `amplification()`, how much further than by its lumped mass a node may move, which shortens stable steps;
///  - `velocity(before, motion, restored)`, that of a particle at the middle of the step [m/s], from that at the middle
///    of the step before, what the nodes give, and the terms of passes from the start, sum S_ip (u_1 + ... ).
struct PlainTransfer {
  static constexpr CarriedGradient carried_gradient = CarriedGradient::none;
  static constexpr bool filters = true;
  static constexpr Passes passes = Passes::none;
  static constexpr int n_passes() { return 0; }
  static constexpr double amplification() { return 1; }

  /// The velocity of the nodes.
  template <int D>
  Vector<D> velocity(const Vector<D>&, const ParticleMotion<D>& motion, const Vector<D>&) const
  {
    return motion.velocity;
  }
};

}  // namespace tamp::components
