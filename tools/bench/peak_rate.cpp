#include "tools/bench/peak_rate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "components/lanes.hpp"
#include "tools/system/processor_time.hpp"

namespace tamp::tools::bench
{

namespace
{

/// Chains of either kind that do not wait for each other: enough for two units with a latency of four cycles or three,
/// and few enough to stay in sixteen registers.
constexpr std::size_t n_chains = 6;

using Chains = std::array<Lanes, n_chains>;

}  // namespace

double multiplies_and_adds_per_second()
{
  constexpr int n_passes = 5;
  constexpr long n_rounds = 1'000'000;
  // Neither a product nor a sum becomes too large or too small, and none can be foreseen.
  volatile double nearly_one = 1 + 1e-9, small = 1e-9;
  const Lanes factor = nearly_one, summand = small;
  Chains products, sums;
  products.fill(1);
  sums.fill(1);
  double best = 0;
  for (int pass = 0; pass < n_passes; ++pass) {
    const double start = thread_seconds();
    for (long round = 0; round < n_rounds; ++round) {
      for (std::size_t k = 0; k < n_chains; ++k) products[k] *= factor;
      for (std::size_t k = 0; k < n_chains; ++k) sums[k] += summand;
    }
    const double passed = thread_seconds() - start;
    best = std::max(best, 2.0 * n_chains * n_lanes * static_cast<double>(n_rounds) / passed);
  }
  Lanes all = 0;
  for (std::size_t k = 0; k < n_chains; ++k) all += products[k] + sums[k];
  return reduce(all) > 0 ? best : 0;
}

}  // namespace tamp::tools::bench
