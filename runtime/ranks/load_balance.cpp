#include "runtime/ranks/load_balance.hpp"

#include <utility>

#include "runtime/grid/curve_order.hpp"
#include "runtime/ranks/deal_patches.hpp"

namespace tamp::runtime
{

namespace
{

std::vector<double> sum_over_ranks(const std::vector<double>& own, const Communicator& communicator)
{
  std::vector<double> sums(own.size(), 0.0);
  for (const auto& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
    const auto* theirs = reinterpret_cast<const double*>(bytes.data());
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += theirs[p];
  }
  return sums;
}

bool pays(const NewDeal& deal, const PatchLayout& layout, std::span<const double> costs, double least_gain)
{
  const int n_ranks = layout.n_ranks();
  return imbalance(costs, layout.ranks(), n_ranks) >= least_gain * imbalance(costs, deal.ranks, n_ranks);
}

}  // namespace

std::optional<NewDeal> better_deal(const PatchLayout& layout, std::span<const double> costs, double least_gain)
{
  const int n_ranks = layout.n_ranks();
  NewDeal deal;
  deal.ranks = deal_patches(curve_order(layout.n_patches()), costs, n_ranks);
  deal.imbalance_before = imbalance(costs, layout.ranks(), n_ranks);
  deal.imbalance_expected = imbalance(costs, deal.ranks, n_ranks);
  if (deal.imbalance_before < least_gain * deal.imbalance_expected) return std::nullopt;
  return deal;
}

std::optional<std::vector<int>> LoadBalance::look(long step, const PatchLayout& layout,
                                                  const std::vector<double>& own_costs,
                                                  const Communicator& communicator)
{
  looked_before_ = step;
  const std::vector<double> costs = sum_over_ranks(own_costs, communicator);
  if (!rebalances_.empty() && rebalances_.back().imbalance_got == 0) {
    rebalances_.back().imbalance_got = imbalance(costs, layout.ranks(), layout.n_ranks());
  }
  std::vector<double> both = costs;
  const std::vector<double> before = std::exchange(costs_before_, costs);
  if (before.empty()) return std::nullopt;
  for (std::size_t p = 0; p < both.size(); ++p) both[p] += before[p];
  constexpr double least_gain = 1.1;
  const auto deal = better_deal(layout, both, least_gain);
  if (!deal || !pays(*deal, layout, costs, least_gain) || !pays(*deal, layout, before, least_gain)) return std::nullopt;
  costs_before_.clear();
  rebalances_.push_back({step, deal->imbalance_before, deal->imbalance_expected, 0});
  return deal->ranks;
}

}  // namespace tamp::runtime
