#include "tools/bench/tasks_kernel.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

using Lanes [[gnu::vector_size(32)]] = double;

// More chains than latency times throughput of any multiply-add unit, and few enough for sixteen registers.
constexpr std::size_t n_chains = 12;

constexpr int slice_iterations = 30'000;
constexpr int n_slices = 15;

std::vector<double> slices_ns()
{
  std::vector<double> ns;
  double sum = 0;
  for (int slice = 0; slice < n_slices; ++slice) {
    const auto start = std::chrono::steady_clock::now();
    sum += multiply_add_kernel(slice_iterations);
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - start;
    ns.push_back(passed.count() / slice_iterations);
  }
  if (!(sum > 0)) throw std::logic_error("the calibration kernel gave no number");
  return ns;
}

}  // namespace

double multiply_add_kernel(int n_iterations)
{
  std::array<Lanes, n_chains> a;
  for (std::size_t k = 0; k < n_chains; ++k) a[k] = Lanes{} + 2.0 + static_cast<double>(k);
  // Towards the fixed point 1: neither overflow nor denormal numbers, however long it goes on.
  const Lanes factor = Lanes{} + 0.999, offset = Lanes{} + 0.001;
  for (int i = 0; i < n_iterations; ++i) {
    for (Lanes& chain : a) chain = chain * factor + offset;
  }
  Lanes sum{};
  for (const Lanes& chain : a) sum += chain;
  return sum[0] + sum[1] + sum[2] + sum[3];
}

double kernel_ns(int n_threads)
{
  std::vector<std::vector<double>> ns(static_cast<std::size_t>(n_threads));
  std::atomic<int> n_waiting{n_threads};
  const auto measure = [&](std::size_t thread) {
    --n_waiting;
    while (n_waiting > 0) std::this_thread::yield();
    ns[thread] = slices_ns();
  };
  std::vector<std::thread> others;
  for (std::size_t thread = 1; thread < ns.size(); ++thread) others.emplace_back(measure, thread);
  measure(0);
  for (std::thread& other : others) other.join();

  std::vector<double> all;
  for (const auto& of_thread : ns) all.insert(all.end(), of_thread.begin(), of_thread.end());
  return median(std::move(all));
}

}  // namespace tamp::tools::bench
