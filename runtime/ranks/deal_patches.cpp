#include "runtime/ranks/deal_patches.hpp"

#include <algorithm>
#include <numeric>

namespace tamp::runtime
{

namespace
{

double cost_of(std::span<const double> costs, int patch)
{
  return costs[static_cast<std::size_t>(patch)];
}

/// Stretches of the row, each as long as `limit` allows; empty when they are more than there are ranks.
std::vector<int> cut(std::span<const int> order, std::span<const double> costs, int n_ranks, double limit)
{
  std::vector<int> ranks(order.size());
  int rank = 0;
  double filled = 0;
  for (const int patch : order) {
    const double cost = cost_of(costs, patch);
    if (filled > 0 && filled + cost > limit) {
      if (++rank == n_ranks) return {};
      filled = 0;
    }
    filled += cost;
    ranks[static_cast<std::size_t>(patch)] = rank;
  }
  return ranks;
}

}  // namespace

std::vector<int> deal_patches(std::span<const int> order, std::span<const double> costs, int n_ranks)
{
  double too_little = 0;
  double enough = std::accumulate(costs.begin(), costs.end(), 0.0);
  std::vector<int> best = cut(order, costs, n_ranks, enough);
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double limit = 0.5 * (too_little + enough);
    if (auto ranks = cut(order, costs, n_ranks, limit); ranks.empty()) {
      too_little = limit;
    } else {
      best = std::move(ranks);
      enough = limit;
    }
  }
  return best;
}

double imbalance(std::span<const double> costs, std::span<const int> ranks, int n_ranks)
{
  std::vector<double> loads(static_cast<std::size_t>(n_ranks), 0.0);
  for (std::size_t p = 0; p < ranks.size(); ++p) loads[static_cast<std::size_t>(ranks[p])] += costs[p];
  const double sum = std::accumulate(loads.begin(), loads.end(), 0.0);
  return sum > 0 ? *std::max_element(loads.begin(), loads.end()) * n_ranks / sum : 1;
}

}  // namespace tamp::runtime
