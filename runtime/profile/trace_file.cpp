#include "runtime/profile/trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tamp::runtime
{

namespace
{

std::string quoted(const std::string& text)
{
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A time of the trace in whole nanoseconds, so that times in the file keep the order of the ticks.
using Nanoseconds = std::int64_t;

/// Microseconds, the unit of the trace-event format.
double microseconds(Nanoseconds time)
{
  return static_cast<double>(time) / 1000;
}

/// Start and end of an event, whose length is never negative.
struct Span {
  Nanoseconds from = 0;
  Nanoseconds until = 0;

  double start() const { return microseconds(from); }
  double length() const { return microseconds(until - from); }
};

class TraceWriter
{
 public:
  TraceWriter(const Trace& trace, const std::function<void(std::string_view)>& write,
              const nlohmann::ordered_json& about);
  void write_all();

 private:
  /// A step of a rank.
  struct Part {
    const TracedStep& step;
    std::span<const TracedTask> tasks;
    std::span<const TracedMessage> messages;
    /// Its first message has its arrow's number.
    std::uint64_t first_arrow;
  };

  void name_tracks();
  void name_track(int track, int place, const std::string& name);
  void write_steps();
  void write_step(const Part& part);
  void write_task(const Part& part, const TracedTask& task);
  void write_arrows(const Part& part, const TracedTask& task);
  void write_messages(const Part& part);
  void write_message(const Part& part, const TracedMessage& message);
  std::size_t lane(const Span& span);

  const Trace::Rank& rank() const { return trace_.ranks[static_cast<std::size_t>(rank_)]; }
  Nanoseconds time(std::uint64_t tick, int rank) const;
  Span span(std::uint64_t start, std::uint64_t end) const { return {time(start, rank_), time(end, rank_)}; }
  int track_of_steps() const { return rank().n_workers; }
  int track_of_messages(std::size_t lane) const { return rank().n_workers + 1 + static_cast<int>(lane); }
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values);
  void flush();

  const Trace& trace_;
  const std::function<void(std::string_view)>& write_;
  const nlohmann::ordered_json& about_;
  std::string text_;
  const char* before_ = "\n";
  /// Names and categories by task, and names by group, as JSON strings.
  std::vector<std::string> names_, categories_, groups_;
  /// Arrows of messages have numbers that sender and receiver know alike; those between tasks follow.
  std::uint64_t next_arrow_ = 0;
  /// The rank that is being written, and until when each of its tracks of messages is taken.
  int rank_ = 0;
  std::vector<Nanoseconds> lanes_;
};

TraceWriter::TraceWriter(const Trace& trace, const std::function<void(std::string_view)>& write,
                         const nlohmann::ordered_json& about)
    : trace_(trace), write_(write), about_(about)
{
  names_.reserve(trace.tasks.size());
  categories_.reserve(trace.tasks.size());
  groups_.reserve(trace.groups.size());
  for (const Trace::Task& task : trace.tasks) {
    names_.push_back(quoted(task.name));
    categories_.push_back(quoted(task.category));
  }
  for (const std::string& group : trace.groups) groups_.push_back(quoted(group));
  if (trace.ranks.empty()) return;
  for (const TracedStep& step : trace.ranks.front().tape.steps) next_arrow_ += step.n_messages_of_all;
}

/// An event, in pieces of some size.
template <class... Values>
void TraceWriter::add(fmt::format_string<Values...> format, Values&&... values)
{
  constexpr std::size_t piece = 1U << 16;
  text_ += before_;
  before_ = ",\n";
  fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  if (text_.size() > piece) flush();
}

void TraceWriter::flush()
{
  write_(text_);
  text_.clear();
}

Nanoseconds TraceWriter::time(std::uint64_t tick, int rank) const
{
  const std::uint64_t common = trace_.ranks[static_cast<std::size_t>(rank)].clock.first_rank(tick);
  return std::llround(static_cast<double>(static_cast<std::int64_t>(common - trace_.begin)) * trace_.second * 1e9);
}

void TraceWriter::write_all()
{
  nlohmann::ordered_json about = about_;
  about["clock_uncertainty_us"] = nlohmann::ordered_json::array();
  for (const Trace::Rank& rank : trace_.ranks) {
    const double ns = static_cast<double>(rank.clock.uncertainty()) * trace_.second * 1e9;
    about["clock_uncertainty_us"].push_back(std::round(ns) / 1000);
  }
  text_ = fmt::format(R"({{"displayTimeUnit":"ns","otherData":{},"traceEvents":[)", about.dump());
  for (rank_ = 0; rank_ < static_cast<int>(trace_.ranks.size()); ++rank_) {
    lanes_.clear();
    write_steps();
    name_tracks();
  }
  text_ += "]}\n";
  flush();
}

void TraceWriter::name_tracks()
{
  add(R"({{"name":"process_name","ph":"M","pid":{},"args":{{"name":{}}}}})", rank_,
      quoted(fmt::format("rank {} on {}", rank_, rank().machine)));
  add(R"({{"name":"process_sort_index","ph":"M","pid":{},"args":{{"sort_index":{}}}}})", rank_, rank_);
  name_track(track_of_steps(), 0, "steps");
  for (int w = 0; w < rank().n_workers; ++w) name_track(w, 1 + w, fmt::format("worker {}", w));
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    const int track = track_of_messages(lane);
    name_track(track, track, "messages");
  }
}

void TraceWriter::name_track(int track, int place, const std::string& name)
{
  add(R"({{"name":"thread_name","ph":"M","pid":{},"tid":{},"args":{{"name":"{}"}}}})", rank_, track, name);
  add(R"({{"name":"thread_sort_index","ph":"M","pid":{},"tid":{},"args":{{"sort_index":{}}}}})", rank_, track, place);
}

void TraceWriter::write_steps()
{
  const TraceTape& tape = rank().tape;
  std::span<const TracedTask> tasks(tape.tasks);
  std::span<const TracedMessage> messages(tape.messages);
  std::uint64_t first_arrow = 0;
  for (const TracedStep& step : tape.steps) {
    write_step({step, tasks.first(step.n_tasks), messages.first(step.n_messages), first_arrow});
    tasks = tasks.subspan(step.n_tasks);
    messages = messages.subspan(step.n_messages);
    first_arrow += step.n_messages_of_all;
  }
}

void TraceWriter::write_step(const Part& part)
{
  // A rank may have no patches.
  if (part.tasks.empty()) return;
  const Span whole = span(part.step.start, part.step.end);
  add(R"({{"name":"step {0}","cat":"step","ph":"X","pid":{1},"tid":{2},"ts":{3:.3f},"dur":{4:.3f},)"
      R"("args":{{"step":{0},"dt":{5:.17g}}}}})",
      part.step.number, rank_, track_of_steps(), whole.start(), whole.length(), part.step.size);
  for (const TracedTask& task : part.tasks) {
    write_task(part, task);
    write_arrows(part, task);
  }
  write_messages(part);
}

void TraceWriter::write_task(const Part& part, const TracedTask& task)
{
  const Span ran = span(task.start, task.end);
  std::string more;
  const auto argument = [&](const char* name, const auto& value) { more += fmt::format(R"(,"{}":{})", name, value); };
  if (task.patch >= 0) argument("patch", task.patch);
  if (task.group >= 0) argument("material", groups_[static_cast<std::size_t>(task.group)]);
  if (task.particles > 0) argument("particles", task.particles);
  if (task.bytes > 0) argument("bytes", task.bytes);
  if (task.skipped) argument("skipped", true);
  // Time stamps of two cores may differ by a little; a delay is never negative.
  const bool has_waited = task.ready != 0 && task.start > task.ready;
  if (has_waited) more += fmt::format(R"(,"ready_delay_us":{:.3f})", span(task.ready, task.start).length());
  add(R"({{"name":{},"cat":{},"ph":"X","pid":{},"tid":{},"ts":{:.3f},"dur":{:.3f},"args":{{"step":{}{}}}}})",
      names_[task.row], categories_[task.row], rank_, task.worker, ran.start(), ran.length(), part.step.number, more);
}

/// Both ends lie within the tasks that they belong to: an arrow starts just before the end of its first.
void TraceWriter::write_arrows(const Part& part, const TracedTask& task)
{
  const auto begin_at = [&](const TracedTask& from, Nanoseconds latest) {
    const Span ran = span(from.start, from.end);
    return microseconds(std::max(ran.from, std::min(ran.until - 1, latest)));
  };
  const auto end = [&](const char* kind, char phase, std::uint64_t id, std::uint32_t worker, double at) {
    add(R"({{"name":"{}","cat":"arrow","ph":"{}"{},"id":{},"pid":{},"tid":{},"ts":{:.3f}}})", kind, phase,
        phase == 'f' ? R"(,"bp":"e")" : "", id, rank_, worker, at);
  };
  const Span ran = span(task.start, task.end);
  if (task.cause >= 0) {
    const TracedTask& cause = part.tasks[static_cast<std::size_t>(task.cause)];
    end("waits for", 's', next_arrow_, cause.worker, begin_at(cause, ran.from));
    end("waits for", 'f', next_arrow_, task.worker, ran.start());
    ++next_arrow_;
  }
  if (task.message < 0) return;
  const std::uint64_t id = part.first_arrow + static_cast<std::uint64_t>(task.message);
  if (task.receives) {
    end("message", 'f', id, task.worker, begin_at(task, ran.until));
  } else {
    end("message", 's', id, task.worker, ran.start());
  }
}

void TraceWriter::write_messages(const Part& part)
{
  std::vector<TracedMessage> messages(part.messages.begin(), part.messages.end());
  const auto posted = [&](const TracedMessage& m) { return time(m.posted, m.from_rank); };
  std::sort(messages.begin(), messages.end(),
            [&](const TracedMessage& a, const TracedMessage& b) { return posted(a) < posted(b); });
  for (const TracedMessage& message : messages) write_message(part, message);
}

/// From being posted to being unpacked, and in it the way. Where clocks differ by more than it took, a message seems to
/// arrive before it was posted: times in the arguments are as measured.
void TraceWriter::write_message(const Part& part, const TracedMessage& message)
{
  const Nanoseconds posted = time(message.posted, message.from_rank), arrived = time(message.arrived, rank_);
  const Span whole{std::min(posted, arrived), time(message.unpacked, rank_)};
  const Span way{whole.from, arrived};
  const int track = track_of_messages(lane(whole));
  add(R"({{"name":{},"cat":"message","ph":"X","pid":{},"tid":{},"ts":{:.3f},"dur":{:.3f},"args":{{"step":{},)"
      R"("bytes":{},"from":{},"to":{},"message":{},"posted_us":{:.3f},"arrived_us":{:.3f},"unpacked_us":{:.3f}}}}})",
      names_[message.row], rank_, track, whole.start(), whole.length(), part.step.number, message.bytes,
      message.from_rank, rank_, part.first_arrow + static_cast<std::uint64_t>(message.message), microseconds(posted),
      microseconds(arrived), microseconds(whole.until));
  add(R"({{"name":"on its way","cat":"message","ph":"X","pid":{},"tid":{},"ts":{:.3f},"dur":{:.3f}}})", rank_, track,
      way.start(), way.length());
}

/// Messages that overlap would not nest: the first track that is free by then, or another one.
std::size_t TraceWriter::lane(const Span& span)
{
  auto free = std::find_if(lanes_.begin(), lanes_.end(), [&](Nanoseconds taken) { return taken <= span.from; });
  if (free == lanes_.end()) free = lanes_.insert(lanes_.end(), 0);
  *free = span.until;
  return static_cast<std::size_t>(free - lanes_.begin());
}

}  // namespace

void write_trace(const Trace& trace, const std::function<void(std::string_view)>& write,
                 const nlohmann::ordered_json& about)
{
  TraceWriter(trace, write, about).write_all();
}

}  // namespace tamp::runtime
