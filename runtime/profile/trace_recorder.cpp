#include "runtime/profile/trace_recorder.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tamp::runtime
{

void TraceTape::clear()
{
  steps.clear();
  tasks.clear();
  messages.clear();
}

std::size_t TraceTape::n_bytes() const
{
  return steps.capacity() * sizeof(TracedStep) + tasks.capacity() * sizeof(TracedTask) +
         messages.capacity() * sizeof(TracedMessage);
}

void TraceRecorder::follow(const BoundGraph& graph, const std::vector<std::size_t>& row_of_instance)
{
  graph_ = &graph;
  row_of_instance_ = &row_of_instance;
  const int n = graph.n_instances();
  local_.clear();
  place_.assign(static_cast<std::size_t>(n), -1);
  for (int i = 0; i < n; ++i) {
    if (!graph.is_local(i)) continue;
    place_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(local_.size());
    local_.push_back(i);
  }
}

void TraceRecorder::add_step(const StepFacts& facts, const std::vector<InstanceRecord>& records, std::uint64_t start,
                             std::uint64_t end, float wall)
{
  ++n_run_;
  const TracedStep step{facts.number, facts.size, start, end, 0, 0, graph_->graph().messages().size()};
  if (choice_.kind == TraceChoice::Kind::slowest) {
    settle(facts.previous_wall);
    // In the very first step memory is touched for the first time: any other is slower than it.
    wall_ = n_run_ == 1 ? 0 : wall;
    // A single rank knows at once how long a step took; several know it one step later.
    const bool may_be_slowest = graph_->has_messages() || wall_ > slowest_;
    if (may_be_slowest && records.size() <= most_tasks) record(last_, step, records);
  } else if (is_wanted(facts)) {
    record(kept_, step, records);
  }
}

/// All ranks know the whole graph, so that they find alike what fits.
bool TraceRecorder::is_wanted(const StepFacts& facts)
{
  if (choice_.kind == TraceChoice::Kind::none) return false;
  const std::int64_t number = choice_.kind == TraceChoice::Kind::first ? n_run_ : facts.number;
  if (number < choice_.first || number > choice_.last) return false;
  n_tasks_ += graph_->graph().instances().size();
  return n_tasks_ <= most_tasks;
}

/// Keeps the last step instead of the slowest before, now that all ranks know how long it took.
void TraceRecorder::settle(float previous_wall)
{
  if (last_.steps.empty()) return;
  if (previous_wall > slowest_) {
    std::swap(kept_, last_);
    slowest_ = previous_wall;
  }
  last_.clear();
}

void TraceRecorder::record(TraceTape& tape, const TracedStep& step, const std::vector<InstanceRecord>& records) const
{
  const std::size_t first = tape.tasks.size(), first_message = tape.messages.size();
  tape.tasks.resize(first + local_.size());
  for (std::size_t k = 0; k < local_.size(); ++k) {
    const int i = local_[k];
    tape.tasks[first + k] = task_of(i, records);
    const TracedTask& task = tape.tasks[first + k];
    if (task.receives) tape.messages.push_back(message_of(task.message, records));
  }
  tape.steps.push_back(step);
  tape.steps.back().n_tasks = local_.size();
  tape.steps.back().n_messages = tape.messages.size() - first_message;
}

TracedTask TraceRecorder::task_of(int i, const std::vector<InstanceRecord>& records) const
{
  const auto at = static_cast<std::size_t>(i);
  const Instance& instance = graph_->graph().instances()[at];
  TracedTask task;
  task.start = records[at].start;
  task.end = records[at].end;
  task.worker = records[at].worker;
  task.row = static_cast<std::uint32_t>((*row_of_instance_)[at]);
  task.patch = instance.patch;
  task.group = instance.group;
  task.receives = instance.kind == InstanceKind::receive_message;
  if (task.receives || instance.kind == InstanceKind::send_message) task.message = instance.message;
  task.bytes = graph_->bytes(i);
  task.particles = graph_->n_particles(i);
  task.skipped = graph_->was_skipped(i);
  for (const int p : instance.predecessors) {
    const std::int32_t place = place_[static_cast<std::size_t>(p)];
    const std::uint64_t end = records[static_cast<std::size_t>(p)].end;
    if (place < 0 || end <= task.ready) continue;
    task.cause = place;
    task.ready = end;
  }
  if (task.receives) {
    const std::uint64_t arrived = graph_->message_times(instance.message).arrived;
    if (arrived >= task.ready) task.cause = -1;
    task.ready = std::max(task.ready, arrived);
  }
  return task;
}

TracedMessage TraceRecorder::message_of(int message, const std::vector<InstanceRecord>& records) const
{
  const Message& m = graph_->graph().messages()[static_cast<std::size_t>(message)];
  const MessageTimes& times = graph_->message_times(message);
  const auto receive = static_cast<std::size_t>(m.receive);
  return {times.posted,
          times.arrived,
          records[receive].end,
          times.n_bytes,
          m.from_rank,
          message,
          static_cast<std::uint32_t>((*row_of_instance_)[receive])};
}

const TraceTape& TraceRecorder::tape(const Communicator& communicator) const
{
  if (choice_.kind != TraceChoice::Kind::slowest) return kept_;
  return communicator.max(double{wall_}) > slowest_ ? last_ : kept_;
}

std::size_t TraceRecorder::n_steps() const
{
  return choice_.kind == TraceChoice::Kind::slowest ? std::min<std::size_t>(kept_.steps.size() + last_.steps.size(), 1)
                                                    : kept_.steps.size();
}

namespace
{

/// Receives `n` values of another rank's tape.
template <class T>
std::vector<T> received(int from, std::size_t n, const Communicator& communicator)
{
  std::vector<T> values(n);
  communicator.receive(from, std::as_writable_bytes(std::span(values)));
  return values;
}

std::string own_machine()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace

std::vector<Trace::Rank> gather_tapes(const TraceTape& own, const ClockLine& clock, int n_workers,
                                      const Communicator& communicator)
{
  struct Head {
    ClockLine clock;
    int n_workers;
    std::size_t n_steps, n_tasks, n_messages;
  };
  const std::vector<std::string> machines = communicator.gather(own_machine());
  const std::vector<Head> heads =
      communicator.gather_value(Head{clock, n_workers, own.steps.size(), own.tasks.size(), own.messages.size()});
  if (!communicator.is_first()) {
    communicator.send(0, std::as_bytes(std::span(own.steps)));
    communicator.send(0, std::as_bytes(std::span(own.tasks)));
    communicator.send(0, std::as_bytes(std::span(own.messages)));
    return {};
  }
  std::vector<Trace::Rank> ranks{{machines.front(), n_workers, clock, own}};
  for (int r = 1; r < communicator.size(); ++r) {
    const Head& head = heads[static_cast<std::size_t>(r)];
    auto steps = received<TracedStep>(r, head.n_steps, communicator);
    auto tasks = received<TracedTask>(r, head.n_tasks, communicator);
    auto messages = received<TracedMessage>(r, head.n_messages, communicator);
    ranks.push_back({machines[static_cast<std::size_t>(r)],
                     head.n_workers,
                     head.clock,
                     {std::move(steps), std::move(tasks), std::move(messages)}});
  }
  return ranks;
}

}  // namespace tamp::runtime
