#include "tools/bench/triad.hpp"

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

double triad_bytes_per_second(std::size_t n)
{
  constexpr int n_passes = 5;
  std::vector<double> a(n, 0.0);
  std::vector<double> b(n, 1.0);
  std::vector<double> c(n, 2.0);
  double best = 0;
  for (int pass = 0; pass < n_passes; ++pass) {
    const double scale = 1.0 + pass;
    const double start = thread_seconds();
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + scale * c[i];
    const double passed = thread_seconds() - start;
    best = std::max(best, 3 * sizeof(double) * static_cast<double>(n) / passed);
    // The next pass reads what this one wrote, so none can be left out.
    std::swap(a, b);
  }
  return b[n / 2] > 0 ? best : 0;
}

double triad_bytes_per_second_each(int n_threads)
{
  // 100 MB each, more than caches hold, and together no more than 400 MB.
  const std::size_t n = (std::size_t{1} << 24) / static_cast<std::size_t>(std::max(n_threads, 4));
  std::vector<double> rates(static_cast<std::size_t>(n_threads));
  std::vector<std::thread> threads;
  threads.reserve(rates.size());
  for (double& rate : rates) threads.emplace_back([&rate, n] { rate = triad_bytes_per_second(n); });
  for (std::thread& thread : threads) thread.join();
  return median(rates);
}

}  // namespace tamp::tools::bench
