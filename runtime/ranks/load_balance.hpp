#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/grid/patch_layout.hpp"

namespace tamp::runtime
{

/// Patches dealt anew to the ranks. An imbalance is the load of the busiest rank over the mean.
struct NewDeal {
  std::vector<int> ranks;
  double imbalance_before;
  double imbalance_expected;
};

/// A dealing along the space-filling curve that suits these costs better than the layout's own, if it shortens the
/// busiest rank's work by more than `least_gain` (1.1 is a tenth): moving patches costs, and costs vary.
std::optional<NewDeal> better_deal(const PatchLayout& layout, std::span<const double> costs, double least_gain);

}  // namespace tamp::runtime
