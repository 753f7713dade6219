#include "runtime/execute/scheduler/reserved_threads.hpp"

#include <oneapi/tbb/global_control.h>

#include <cstddef>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

namespace tamp::runtime
{

namespace
{

using oneapi::tbb::global_control;

constexpr auto limit = global_control::max_allowed_parallelism;

/// All that the teams of this program hold together: of several limits the lowest counts, so there is one for them all.
struct Pool {
  std::mutex mutex;
  std::size_t n_reserved = 0;
  /// Threads that the program may use beside the teams, the calling one counted.
  std::size_t n_others = 0;
  std::optional<global_control> control;

  void resize(std::size_t n)
  {
    control.reset();
    if (n_reserved == 0) n_others = global_control::active_value(limit);
    n_reserved = n;
    if (n > 0) control.emplace(limit, n_others + n);
  }
};

Pool& pool()
{
  static Pool all;
  return all;
}

}  // namespace

ReservedThreads::ReservedThreads(int n_threads) : n_threads_(n_threads)
{
  Pool& all = pool();
  const std::lock_guard lock(all.mutex);
  const std::size_t before = all.n_reserved, wanted = before + static_cast<std::size_t>(n_threads);
  all.resize(wanted);
  const std::size_t allowed = global_control::active_value(limit);
  if (allowed > wanted) return;
  all.resize(before);
  throw std::runtime_error("this program limits oneTBB to " + std::to_string(allowed) + " threads; expected at least " +
                           std::to_string(wanted + 1));
}

ReservedThreads::~ReservedThreads()
{
  Pool& all = pool();
  const std::lock_guard lock(all.mutex);
  all.resize(all.n_reserved - static_cast<std::size_t>(n_threads_));
}

}  // namespace tamp::runtime
