#include "runtime/ranks/deal_patches.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "runtime/ranks/load_balance.hpp"

namespace tamp::runtime::test_deal_patches
{

namespace
{

/// The least cost of the costliest stretch, by trying every cut.
double best_by_trial(const std::vector<double>& costs, std::size_t first, int n_ranks)
{
  if (n_ranks == 1) return std::accumulate(costs.begin() + static_cast<std::ptrdiff_t>(first), costs.end(), 0.0);
  double best = std::numeric_limits<double>::infinity();
  double own = 0;
  for (std::size_t end = first; end <= costs.size(); ++end) {
    best = std::min(best, std::max(own, best_by_trial(costs, end, n_ranks - 1)));
    if (end < costs.size()) own += costs[end];
  }
  return best;
}

}  // namespace

TEST_CASE("a row is cut so that the costliest stretch is as cheap as any cut can make it", "[ranks of patches]")
{
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> cost(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> costs(10);
    for (double& c : costs) c = trial % 3 == 0 ? std::floor(4 * cost(chance)) : cost(chance);
    std::vector<int> order(costs.size());
    std::iota(order.begin(), order.end(), 0);
    const int n_ranks = 1 + trial % 4;

    const std::vector<int> ranks = deal_patches(order, costs, n_ranks);

    const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / n_ranks;
    CHECK(std::is_sorted(ranks.begin(), ranks.end()));
    CHECK(ranks.back() < n_ranks);
    CHECK(imbalance(costs, ranks, n_ranks) == Approx(mean > 0 ? best_by_trial(costs, 0, n_ranks) / mean : 1));
  }
}

TEST_CASE("patches are dealt anew only for a gain that is worth it", "[ranks of patches]")
{
  PatchLayout layout({2, {0, 0, 0}, 1, {16, 4, 1}}, {4, 1, 1});
  layout.give_to_ranks({0, 0, 1, 1}, 2);

  CHECK_FALSE(better_deal(layout, std::vector<double>{1, 1, 1, 1}, 1.1));
  CHECK_FALSE(better_deal(layout, std::vector<double>{1.05, 1, 1, 1}, 1.1));
  const auto deal = better_deal(layout, std::vector<double>{3, 1, 1, 1}, 1.1);
  REQUIRE(deal);
  CHECK(deal->ranks == std::vector<int>{0, 1, 1, 1});
  CHECK(deal->imbalance_before == Approx(4.0 / 3));
  CHECK(deal->imbalance_expected == Approx(1));
}

TEST_CASE("patches move when the same deal pays in two intervals in a row, and not for noise", "[ranks of patches]")
{
  PatchLayout layout({2, {0, 0, 0}, 1, {16, 4, 1}}, {4, 1, 1});
  layout.give_to_ranks({0, 0, 1, 1}, 2);
  const std::vector<double> even{1, 1, 1, 1}, first_dear{3, 1, 1, 1}, last_dear{1, 1, 1, 3};
  LoadBalance balance;
  const auto look = [&](long step, const std::vector<double>& costs) { return balance.look(step, layout, costs, {}); };

  CHECK_FALSE(look(10, first_dear));
  CHECK_FALSE(look(20, even));
  CHECK_FALSE(look(30, last_dear));
  CHECK_FALSE(look(40, first_dear));
  CHECK(look(50, first_dear) == std::vector<int>{0, 1, 1, 1});
  // The next two intervals decide again.
  CHECK_FALSE(look(60, last_dear));
  REQUIRE(balance.rebalances().size() == 1);
  // By the ranks of the layout, which the host has not dealt anew here.
  CHECK(balance.rebalances()[0].imbalance_got == Approx(4.0 / 3));
}

}  // namespace tamp::runtime::test_deal_patches
