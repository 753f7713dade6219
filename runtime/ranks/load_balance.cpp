#include "runtime/ranks/load_balance.hpp"

#include "runtime/grid/curve_order.hpp"
#include "runtime/ranks/deal_patches.hpp"

namespace tamp::runtime
{

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

}  // namespace tamp::runtime
