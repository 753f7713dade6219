#include "tools/bench/slow_task.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "runtime/execute/clock.hpp"

namespace tamp::tools::bench
{

bool slow_down(runtime::TaskList& step, const std::string& task, double factor)
{
  const auto found = std::ranges::find(step, task, &runtime::TaskDeclaration::name);
  if (found == step.end() || !found->body) return false;
  found->body = [body = std::move(found->body), factor](const runtime::TaskContext& at,
                                                        const runtime::BoundArgument* data) {
    const std::uint64_t start = runtime::ticks();
    body(at, data);
    const auto taken = static_cast<double>(runtime::ticks() - start);
    const std::uint64_t end = start + static_cast<std::uint64_t>(factor * taken);
    while (runtime::ticks() < end) continue;
  };
  return true;
}

}  // namespace tamp::tools::bench
