#include <catch2/catch.hpp>

#include <chrono>
#include <limits>
#include <set>
#include <thread>

#include "runtime/profile/profiler.hpp"
#include "runtime/profile/trace_file.hpp"
#include "tests/runtime/heat.hpp"
#include "tests/trace_reader.hpp"

namespace tamp::test::test_trace
{

namespace
{

std::string text_of(const Trace& trace)
{
  std::string text;
  write_trace(trace, [&](std::string_view piece) { text += piece; });
  return text;
}

std::vector<std::int64_t> numbers(const Trace::Rank& rank)
{
  std::vector<std::int64_t> numbers;
  for (const TracedStep& step : rank.tape.steps) numbers.push_back(step.number);
  return numbers;
}

/// On two threads of each rank, with patches on all of them.
struct Plate : Heat {
  explicit Plate(const Communicator& ranks) : Heat(24, {4, 3, 1}, 2, ranks)
  {
    std::vector<int> dealt;
    for (const Patch& patch : engine.layout()) dealt.push_back(patch.id % ranks.size());
    engine.deal(dealt);
  }
};

const ReductionLabel<double, "sum of nothing"> nothing;

/// A step in which the last patch dawdles where `dawdles` says so, by its number.
template <class Dawdles>
TaskDeclaration dawdle(int n_patches, const Dawdles& dawdles)
{
  return task("dawdle").over_patches().reduces(nothing).body([=](const TaskContext& at, auto) {
    if (at.patch.id != n_patches - 1) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(dawdles(at.step.index + 1)));
  });
}

}  // namespace

TEST_CASE("the trace has every instance of the first steps, and of no others", "[profile]")
{
  Heat heat(16, {2, 2, 1}, 2);
  heat.engine.trace_steps(TraceChoice::first_steps(3));
  heat.run(10, 1e-4);

  const Trace trace = heat.engine.trace();

  CHECK(numbers(trace.ranks.front()) == std::vector<std::int64_t>{1, 2, 3});
  CHECK(trace.ranks.front().tape.tasks.size() == 3 * heat.engine.graph().instances().size());
  CHECK(heat.engine.profile().n_traced_steps == 3);
}

TEST_CASE("a range is traced with both of its ends, on all ranks alike", "[profile][ranks]")
{
  Plate heat(Communicator::world());
  heat.run(2, 1e-4);
  heat.engine.trace_steps(TraceChoice::range(4, 6));
  heat.run(6, 1e-4);

  for (const Trace::Rank& rank : heat.engine.trace().ranks) {
    CHECK(numbers(rank) == std::vector<std::int64_t>{4, 5, 6});
  }
  CHECK(heat.engine.profile().n_traced_steps == 3);
}

TEST_CASE("the slowest step is the one kept on all ranks, whichever rank is slow and when", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  Executor executor(1, on_shared_cores());
  for (const std::int64_t slowest : {2, 5, 8}) {
    PatchLayout layout(Grid{2, {0, 0, 0}, 1, {8, 8, 1}}, {4, 2, 1});
    std::vector<int> dealt;
    for (const Patch& patch : layout) dealt.push_back(patch.id * ranks.size() / 8);
    layout.give_to_ranks(dealt, ranks.size());
    // The first step is not to count.
    const TaskDeclaration tasks = dawdle(8, [=](std::int64_t n) { return n == 1 ? 600 : n == slowest ? 300 : 1; });
    Engine engine(layout, {"all"}, {{{tasks}, {{}, {&nothing}}}}, executor, ranks);
    engine.trace_steps(TraceChoice::slowest());
    for (int n = 0; n < 8; ++n) engine.advance(1);

    const Trace trace = engine.trace();

    for (const Trace::Rank& rank : trace.ranks) CHECK(numbers(rank) == std::vector<std::int64_t>{slowest});
    CHECK(engine.profile().n_traced_steps == 1);
  }
}

TEST_CASE("a run of one step has traced its slowest", "[profile][ranks]")
{
  Plate heat(Communicator::world());
  heat.engine.trace_steps(TraceChoice::slowest());
  heat.run(1, 1e-4);

  for (const Trace::Rank& rank : heat.engine.trace().ranks) CHECK(numbers(rank) == std::vector<std::int64_t>{1});
}

TEST_CASE("no more is traced than fits, and without a wish nothing is", "[profile]")
{
  Heat heat(16, {4, 4, 1}, 1);
  MemoryLedger ledger;
  Profiler wanted(heat.engine.schedule(), heat.engine.bound(), 1),
      unasked(heat.engine.schedule(), heat.engine.bound(), 1);
  wanted.trace_steps(TraceChoice::first_steps(std::numeric_limits<std::int64_t>::max()), ledger.trace);
  const std::size_t n_fit = TraceRecorder::most_tasks / heat.engine.graph().instances().size();
  for (std::size_t n = 0; n < n_fit + 2; ++n) {
    heat.run(1, 1e-4);
    wanted.add_step();
    unasked.add_step();
  }

  CHECK(wanted.trace().ranks.front().tape.tasks.size() == n_fit * heat.engine.graph().instances().size());
  CHECK(unasked.trace().ranks.empty());
}

TEST_CASE("a trace keeps to the format, and no message arrives before it is posted", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  Plate heat(ranks);
  heat.engine.trace_steps(TraceChoice::range(2, 5));
  heat.run(6, 1e-4);

  const Trace trace = heat.engine.trace();
  if (!ranks.is_first()) return;
  const TraceReader reader(text_of(trace));

  for (const std::string& problem : reader.problems()) FAIL_CHECK(problem);
  CHECK(reader.processes().size() == static_cast<std::size_t>(ranks.size()));
  CHECK(reader.processes().begin()->second.starts_with("rank 0 on "));
  const auto messages = reader.slices("posted_us");
  CHECK(messages.size() == 4 * heat.engine.graph().messages().size());
  const auto uncertainty = reader.file()["otherData"]["clock_uncertainty_us"].get<std::vector<double>>();
  for (const TraceReader::Slice& message : messages) {
    const auto posted = message.args["posted_us"].get<double>(), arrived = message.args["arrived_us"].get<double>(),
               unpacked = message.args["unpacked_us"].get<double>();
    const double unsure = uncertainty.at(message.args["from"]) + uncertainty.at(message.args["to"]);
    CHECK(arrived >= posted - unsure);
    CHECK(unpacked >= arrived);
    CHECK(message.args["bytes"].get<std::size_t>() > 0);
  }
  const auto of_message = [](const auto& arrow) { return std::get<1>(arrow.first) == "message"; };
  CHECK(static_cast<std::size_t>(std::count_if(reader.arrows().begin(), reader.arrows().end(), of_message)) ==
        messages.size());
}

TEST_CASE("a trace goes on where patches are dealt to other ranks", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  Plate heat(ranks);
  heat.engine.trace_steps(TraceChoice::first_steps(4));
  heat.run(2, 1e-4);
  heat.engine.deal(std::vector<int>(12, ranks.size() - 1));
  heat.run(2, 1e-4);

  const Trace trace = heat.engine.trace();
  if (!ranks.is_first()) return;
  const TraceReader reader(text_of(trace));

  for (const std::string& problem : reader.problems()) FAIL_CHECK(problem);
  std::set<int> steps;
  for (const TraceReader::Slice& slice : reader.slices("patch")) steps.insert(slice.args["step"].get<int>());
  CHECK(steps == std::set<int>{1, 2, 3, 4});
}

TEST_CASE("an arrow leads from the predecessor that was done last", "[profile]")
{
  Heat heat(16, {2, 2, 1}, 2);
  heat.engine.trace_steps(TraceChoice::range(3, 3));
  heat.run(3, 1e-4);

  const Trace trace = heat.engine.trace();
  const TraceTape& tape = trace.ranks.front().tape;

  const auto& instances = heat.engine.graph().instances();
  REQUIRE(tape.tasks.size() == instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) {
    std::uint64_t last = 0;
    for (const int p : instances[i].predecessors) last = std::max(last, tape.tasks[static_cast<std::size_t>(p)].end);
    const std::int32_t cause = tape.tasks[i].cause;
    CHECK((cause < 0 ? 0 : tape.tasks[static_cast<std::size_t>(cause)].end) == last);
  }
}

TEST_CASE("a reader of traces finds what the format does not allow", "[profile]")
{
  const std::string names = R"({"name":"process_name","ph":"M","pid":0,"args":{"name":"a"}},
                               {"name":"thread_name","ph":"M","pid":0,"tid":0,"args":{"name":"b"}},)";
  const auto n_problems = [&](const std::string& events) {
    return TraceReader("[" + names + events + "]").problems().size();
  };
  const std::string slice = R"({"name":"a","ph":"X","pid":0,"tid":0,"ts":1,"dur":2})";

  CHECK(n_problems(slice) == 0);
  CHECK(n_problems(R"({"name":"a","ph":"X","pid":0,"tid":0,"ts":1})") == 1);
  CHECK(n_problems(R"({"name":"a","ph":"X","pid":0,"tid":1,"ts":1,"dur":1})") == 1);
  CHECK(n_problems(slice + R"(,{"name":"a","ph":"X","pid":0,"tid":0,"ts":2,"dur":2})") == 1);
  CHECK(n_problems(slice + R"(,{"name":"a","ph":"s","id":1,"pid":0,"tid":0,"ts":2})") == 1);
  CHECK(n_problems(slice + R"(,{"name":"a","ph":"s","id":1,"pid":0,"tid":0,"ts":2},
                               {"name":"a","ph":"f","bp":"e","id":1,"pid":0,"tid":0,"ts":1.5})") == 1);
}

}  // namespace tamp::test::test_trace
