#include <fmt/format.h>

#include <catch2/catch.hpp>

#include <set>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"
#include "tests/trace_reader.hpp"

namespace test_run_trace
{

using namespace tamp::test;

namespace
{

const std::string punch = " run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --threads 2 ";

std::set<long> steps_in(const TraceReader& reader)
{
  std::set<long> steps;
  for (const TraceReader::Slice& slice : reader.slices("step")) steps.insert(slice.args["step"].get<long>());
  return steps;
}

void expect_whole(const TraceReader& reader, int n_ranks)
{
  for (const std::string& problem : reader.problems()) FAIL_CHECK(problem);
  CHECK(reader.processes().size() == static_cast<std::size_t>(n_ranks));
  CHECK(reader.file()["otherData"]["ranks"] == n_ranks);
  CHECK_FALSE(reader.file()["otherData"]["processor"].get<std::string>().empty());
  std::set<std::string> categories, materials, tracks;
  for (const auto& [track, name] : reader.tracks()) tracks.insert(name);
  for (const TraceReader::Slice& slice : reader.slices()) {
    categories.insert(slice.category);
    if (slice.args.contains("material")) materials.insert(slice.args["material"].get<std::string>());
  }
  for (const char* track : {"steps", "worker 0", "worker 1"}) CHECK(tracks.contains(track));
  for (const char* category : {"step", "stress", "particles to grid", "contact", "reduction"}) {
    CHECK(categories.contains(category));
  }
  CHECK(materials == std::set<std::string>{"sand", "steel"});
  CHECK(tracks.contains("messages") == (n_ranks > 1));
  CHECK_FALSE(reader.arrows().empty());
}

}  // namespace

TEST_CASE("the trace of a run keeps to the format, on one rank and on two", "[mpiexec]")
{
  for (const int n_ranks : {1, 2}) {
    for (const auto& [choice, steps] :
         std::vector<std::pair<std::string, std::set<long>>>{{"2", {1, 2}}, {"4:6", {4, 5, 6}}, {"7:7", {7}}}) {
      INFO(n_ranks << " ranks, " << choice);
      const TemporaryFolder folder;
      const auto out = folder.path() / "run";

      const Outcome outcome =
          tamp_on_ranks(n_ranks, fmt::format("{}--steps 8 --out {} --trace-steps {}", punch, out.string(), choice));

      CHECK(outcome.exit_code == 0);
      const TraceReader reader(read_text(out / "trace.json"));
      expect_whole(reader, n_ranks);
      CHECK(steps_in(reader) == steps);
    }
  }
}

TEST_CASE("the slowest step is one, and the same on two ranks", "[mpiexec]")
{
  for (const int n_ranks : {1, 2}) {
    const TemporaryFolder folder;
    const auto out = folder.path() / "run";

    const Outcome outcome = tamp_on_ranks(n_ranks, punch + "--steps 20 --trace-steps slowest --out " + out.string());

    CHECK(outcome.exit_code == 0);
    const TraceReader reader(read_text(out / "trace.json"));
    expect_whole(reader, n_ranks);
    const std::set<long> steps = steps_in(reader);
    CHECK(steps.size() == 1);
    CHECK(*steps.begin() > 1);
  }
}

TEST_CASE("steps of a range that a run does not come to are told of at its end")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  const std::string run = punch + "--until 2e-5 --force --out " + out;

  const Outcome partly = tamp_with(run + " --trace-steps 5:20"), not_at_all = tamp_with(run + " --trace-steps 30:99");

  const auto n = nlohmann::json::parse(read_text(folder.path() / "run" / "summary.json"))["steps"].get<long>();
  const std::string last = fmt::format("the run had steps 1 to {}\n", n);
  CHECK_THAT(partly.err,
             Catch::Contains(fmt::format("tamp: --trace-steps 5:20: trace.json holds steps 5 to {}, as ", n) + last));
  CHECK_THAT(not_at_all.err, Catch::Contains("tamp: --trace-steps 30:99: trace.json holds no step, as " + last));
  CHECK(TraceReader(read_text(folder.path() / "run" / "trace.json")).slices().empty());
}

TEST_CASE("without a trace none is written, and one of steps that cannot be is refused before the run")
{
  const TemporaryFolder folder;
  const auto out = folder.path() / "run";
  const std::string run = punch + "--steps 5 --out " + out.string() + " --trace-steps ";

  const Outcome refused = tamp_with(run + "6:9");

  CHECK(refused.exit_code == 2);
  CHECK(refused.err == "tamp: --trace-steps: 6:9; expected steps up to 5, where --steps ends the run\n");
  CHECK_FALSE(std::filesystem::exists(out));
  for (const char* choice : {"none", "0"}) {
    CHECK(tamp_with(run + choice + " --force").exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(out / "trace.json"));
  }
}

}  // namespace test_run_trace
