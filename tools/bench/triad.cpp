#include "tools/bench/triad.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "tools/system/capacity.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

/// Three arrays in one, first touched by the thread that uses them, so that they lie in its memory.
using Arrays = std::unique_ptr<double[]>;

Arrays arrays_of(std::size_t n)
{
  return std::make_unique_for_overwrite<double[]>(3 * n);
}

double rate_with(const Arrays& arrays, std::size_t n)
{
  constexpr int n_passes = 5;
  std::span<double> a(arrays.get(), n), b(a.data() + n, n);
  const std::span<double> c(b.data() + n, n);
  std::ranges::fill(a, 0.0);
  std::ranges::fill(b, 1.0);
  std::ranges::fill(c, 2.0);
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

/// Memory is asked for here: what is thrown in another thread ends the program.
double median_rate(std::size_t n_threads, std::size_t n)
{
  std::vector<Arrays> arrays(n_threads);
  for (Arrays& own : arrays) own = arrays_of(n);
  std::vector<double> rates(n_threads);
  {
    std::vector<std::jthread> threads;
    threads.reserve(n_threads);
    for (std::size_t k = 0; k < n_threads; ++k) {
      threads.emplace_back([&, k] { rates[k] = rate_with(arrays[k], n); });
    }
  }
  return median(rates);
}

}  // namespace

double triad_bytes_per_second(std::size_t n)
{
  return rate_with(arrays_of(n), n);
}

double triad_bytes_per_second_each(int n_threads)
{
  // 100 MB each, and 400 MB together; but each 24 MB at least, more than it has of the caches.
  const auto n_workers = static_cast<std::size_t>(std::max(n_threads, 1));
  const std::size_t n = std::max((std::size_t{1} << 24) / std::max<std::size_t>(n_workers, 4), std::size_t{1} << 20);
  const double bytes = 3.0 * sizeof(double) * static_cast<double>(n) * static_cast<double>(n_workers);
  if (2 * bytes > free_memory().bytes) return 0;
  try {
    return median_rate(n_workers, n);
  } catch (const std::bad_alloc&) {
    return 0;
  } catch (const std::system_error&) {
    return 0;
  }
}

}  // namespace tamp::tools::bench
