#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/grid/patch_layout.hpp"
#include "runtime/ranks/communicator.hpp"

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

/// A new deal that was made before a step.
struct Rebalance {
  long step = 0;
  double imbalance_before = 1;
  double imbalance_expected = 1;
  /// Measured over the steps that followed; 0 before there were enough.
  double imbalance_got = 0;
};

/// Looks at the load of the ranks every so many steps, and remembers what it found. What is uneven in one interval may
/// be even in the next: patches move when a deal would have paid in two in a row.
class LoadBalance
{
 public:
  /// Steps between two looks; 0: none.
  void look_every(long n_steps) { interval_ = n_steps; }
  /// Once before a step, however often that is tried.
  bool is_due(long step) const { return interval_ > 0 && step > 0 && step % interval_ == 0 && step != looked_before_; }
  /// The ranks of a better deal before a step, if it pays. `own_costs`, by patch [s], are those since the last look on
  /// this rank's patches, and 0 on others. Collective.
  std::optional<std::vector<int>> look(long step, const PatchLayout& layout, const std::vector<double>& own_costs,
                                       const Communicator& communicator);
  const std::vector<Rebalance>& rebalances() const { return rebalances_; }

 private:
  long interval_ = 0;
  long looked_before_ = -1;
  /// Costs of all patches in the interval before [s]; empty after a deal.
  std::vector<double> costs_before_;
  std::vector<Rebalance> rebalances_;
};

}  // namespace tamp::runtime
