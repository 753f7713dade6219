#pragma once

#include <stdexcept>

#include "components/transfers/affine.hpp"
#include "components/transfers/apic.hpp"
#include "components/transfers/blend.hpp"
#include "components/transfers/flip.hpp"
#include "components/transfers/fmpm.hpp"
#include "components/transfers/pic.hpp"
#include "components/transfers/tpic.hpp"
#include "components/transfers/xpic.hpp"

namespace tamp::components
{

/// What a scene says of a transfer.
struct TransferChoice {
  Transfer transfer;
  /// Of a blend, 0 to 1.
  double flip_part;
  /// Of XPIC and FMPM, at least 1.
  int filter_order;
};

/// Calls `visit(transfer)` with what `choice` names: the one list of all transfers.
template <class Visit>
auto with_transfer(const TransferChoice& choice, Visit&& visit)
{
  switch (choice.transfer) {
    case Transfer::flip:
      return visit(Flip{});
    case Transfer::pic:
      return visit(Pic{});
    case Transfer::blend:
      return visit(Blend{{}, choice.flip_part});
    case Transfer::affine:
      return visit(Affine{});
    case Transfer::apic:
      return visit(Apic{});
    case Transfer::tpic:
      return visit(Tpic{});
    case Transfer::xpic:
      return visit(Xpic{{}, choice.filter_order});
    case Transfer::fmpm:
      return visit(Fmpm{{}, choice.filter_order});
  }
  throw std::logic_error("unknown transfer");
}

inline Surroundings surroundings_of(const TransferChoice& choice)
{
  return with_transfer(choice, [](const auto& transfer) { return transfer.surroundings; });
}

}  // namespace tamp::components
