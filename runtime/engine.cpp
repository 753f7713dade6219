#include "runtime/engine.hpp"

#include <algorithm>
#include <exception>
#include <tuple>
#include <utility>

#include "runtime/execute/on_workers.hpp"
#include "runtime/graph/step_verdict.hpp"
#include "runtime/ranks/common_failure.hpp"

namespace tamp::runtime
{

namespace
{

const GlobalLabel<Progress, "progress"> progress_label;

/// Requests that the hosts of the ranks share, and how long the step before took the rank that took longest [s].
struct Requests {
  float previous_wall = 0;
  unsigned bits = 0;

  static constexpr auto fields = std::tuple{Greatest{&Requests::previous_wall}, AnyBit{&Requests::bits}};
};
const ReductionLabel<Requests, "requests"> requests_label;

/// On every patch, with particles or without, so that every rank that has one is heard.
TaskDeclaration gather_requests()
{
  return task("gather requests").over_patches().reduces(requests_label).body([](const TaskContext& at, auto data) {
    data[requests_label] = {at.step.previous_wall, at.step.host_requests};
  });
}

bool may_refuse(const TaskList& step)
{
  return std::any_of(step.begin(), step.end(),
                     [](const TaskDeclaration& task) { return task.uses(Mode::compute, step_verdict); });
}

/// The graphs, with the tasks that the engine itself adds to a step.
std::vector<GraphTasks> with_own(std::vector<GraphTasks> graphs)
{
  auto& [tasks, host] = graphs.front();
  if (may_refuse(tasks)) host.results.push_back(&step_verdict);
  tasks.insert(tasks.begin(), gather_requests());
  host.state.push_back(&progress_label);
  host.results.push_back(&requests_label);
  return graphs;
}

}  // namespace

Engine::Engine(const PatchLayout& layout, std::vector<std::string> group_names, std::vector<GraphTasks> graphs,
               Executor& executor, const Communicator& communicator)
    : group_names_(std::move(group_names)),
      tasks_(with_own(std::move(graphs))),
      executor_(executor),
      communicator_(communicator),
      after_failure_(communicator.duplicate()),
      clocks_(communicator),
      compiled_(compiled_on(layout)),
      warehouse_(compiled_->pointers(), communicator.rank()),
      ready_(ready(*compiled_)),
      profiler_(schedule(), bound(), executor.n_threads()),
      held_by_graph_(warehouse_.ledger().graph, 0)
{
  held_by_graph_.hold(static_cast<std::size_t>(std::max(beyond_ledger(), std::ptrdiff_t{0})));
  look_for_idle_ranks();
}

/// Growth of the heap since the start beyond what the ledger knows of [bytes]: the graphs and what goes with them,
/// which are too many small pieces to be counted one by one.
std::ptrdiff_t Engine::beyond_ledger() const
{
  return static_cast<std::ptrdiff_t>(heap_bytes()) - static_cast<std::ptrdiff_t>(heap_at_start_) -
         static_cast<std::ptrdiff_t>(warehouse_.ledger().total().current());
}

std::unique_ptr<CompiledGraphs> Engine::compiled_on(const PatchLayout& layout) const
{
  return std::make_unique<CompiledGraphs>(layout, group_names_, tasks_);
}

std::unique_ptr<ReadyGraphs> Engine::ready(const CompiledGraphs& compiled)
{
  return std::make_unique<ReadyGraphs>(compiled, warehouse_, executor_.n_threads(), communicator_, clocks_);
}

Progress& Engine::now()
{
  return warehouse_.global_state(progress_label);
}

const Progress& Engine::progress() const
{
  return warehouse_.global_state(progress_label);
}

bool Engine::advance(double size, double end)
{
  balance_if_due();
  hear_idle_ranks();
  const auto [n_steps, time, last_size] = progress();
  size = std::min(size, end - time);
  schedule().taking_processor_time = profiler_.takes_processor_time();
  run_step({n_steps, time, size, last_size, requests_, profiler_.wall_to_tell()});
  if (was_refused()) return false;
  if (!is_idle_) requests_ = 0;
  warehouse().advance();
  const Requests& told = warehouse().result(requests_label);
  asked_ = told.bits;
  if (schedule().recording) profiler_.add_step({n_steps + 1, size, told.previous_wall});
  constexpr double round_off = 1e-14;
  clocks_.follow(n_steps + 1);
  now() = {n_steps + 1, time + size >= end * (1 - round_off) ? end : time + size, size};
  return true;
}

bool Engine::was_refused()
{
  return may_refuse(tasks_.front().tasks) && warehouse().result(step_verdict).refused;
}

/// An error of one rank becomes the same error on all.
void Engine::run_step(const Step& step)
{
  std::exception_ptr own;
  try {
    executor_.run(schedule(), step);
    return;
  } catch (const TaskError& error) {
    // An error of the state is thrown as it is; any other with the name of its task.
    own = is_step_error(error.cause) ? error.cause : std::current_exception();
    if (communicator_.size() == 1) std::rethrow_exception(own);
  } catch (const OtherRankFailed&) {
  }
  throw_common_failure(own, step.index, after_failure_);
}

void Engine::run(std::size_t graph, double size)
{
  const Progress& at = progress();
  executor_.run(schedule(graph), {at.n_steps, at.time, size, at.step_size});
}

void Engine::balance_every(long n_steps)
{
  balance_.look_every(n_steps);
  // Some samples of processor time between two looks.
  constexpr long n_samples = 4, seldom = 32;
  if (n_steps > 0) profiler_.take_processor_time_every(std::clamp(n_steps / n_samples, 1L, seldom));
}

void Engine::balance_if_due()
{
  const long step = progress().n_steps;
  if (communicator_.size() == 1 || !balance_.is_due(step)) return;
  const auto watch = executor_.watch("redistributing patches");
  const auto ranks = balance_.look(step, layout(), profiler_.take_patch_costs(), communicator_);
  if (ranks) deal(*ranks);
}

void Engine::look_for_idle_ranks()
{
  std::vector<bool> has_patches(static_cast<std::size_t>(communicator_.size()), false);
  for (const Patch& patch : layout()) has_patches[static_cast<std::size_t>(patch.rank)] = true;
  is_idle_ = !has_patches[static_cast<std::size_t>(communicator_.rank())];
  some_are_idle_ = std::find(has_patches.begin(), has_patches.end(), false) != has_patches.end();
}

/// A rank without patches has no part in what a step gathers. Where there is one, all tell the others of their requests
/// now and then, and those with patches bring them into the step.
void Engine::hear_idle_ranks()
{
  constexpr long every = 8;
  if (!some_are_idle_ || progress().n_steps % every != 0) return;
  const auto watch = executor_.watch("hearing ranks without patches");
  for (const unsigned bits : communicator_.gather_value(requests_)) requests_ |= bits;
  if (is_idle_) requests_ = 0;
}

void Engine::deal(const std::vector<int>& ranks)
{
  const std::size_t held = held_by_graph_.bytes();
  const std::ptrdiff_t before = beyond_ledger();
  const auto hold = [&] {
    held_by_graph_.hold(held + static_cast<std::size_t>(std::max(beyond_ledger() - before, std::ptrdiff_t{0})));
  };
  PatchLayout layout = compiled_->layout;
  layout.give_to_ranks(ranks, communicator_.size());
  auto compiled = compiled_on(layout);
  warehouse_.deal(compiled->pointers(), communicator_);
  auto ready = this->ready(*compiled);
  ready->schedules.front().recording = schedule().recording;
  profiler_.follow(ready->schedules.front(), ready->bound.front());
  hold();
  ready_ = std::move(ready);
  compiled_ = std::move(compiled);
  held_by_graph_.hold(held);
  look_for_idle_ranks();
}

CheckpointHeader Engine::header(const std::string& fingerprint) const
{
  return {progress().n_steps, progress().time, fingerprint};
}

void Engine::write_checkpoint(const std::filesystem::path& folder, const std::string& fingerprint,
                              std::span<const std::byte> host, int keep)
{
  runtime::write_checkpoint(folder, header(fingerprint), host, warehouse(), group_names_, keep, communicator_);
}

CheckpointCopy Engine::copy_checkpoint(const std::string& fingerprint, std::span<const std::byte> host)
{
  // The workers' run has a watch of its own; what follows it is messages.
  std::unique_ptr<Watchdog::Watch> watch;
  const auto for_all = [&](int n, const auto& work) {
    on_workers(executor_, n, work);
    // NOLINTNEXTLINE(modernize-make-unique): a Watch cannot be moved into its place
    watch.reset(new Watchdog::Watch(executor_.watch("gathering the state")));
  };
  return runtime::copy_checkpoint(header(fingerprint), host, warehouse(), group_names_, for_all, communicator_);
}

std::vector<std::byte> Engine::restart(const FoundCheckpoint& found)
{
  read_checkpoint(found, warehouse(), group_names_, communicator_);
  return found.host;
}

}  // namespace tamp::runtime
