#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/tools/program.hpp"

namespace test_graph_command
{

using namespace tamp::test;

namespace
{

const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json";

nlohmann::json dump_on(int n_ranks)
{
  const Outcome outcome = tamp_with("graph " + scene + " --format json --ranks " + std::to_string(n_ranks));
  REQUIRE(outcome.exit_code == 0);
  return nlohmann::json::parse(outcome.out);
}

/// How many edges are messages, and the ranks that have tasks.
struct Seen {
  std::size_t n_messages = 0;
  std::set<int> ranks;
};

Seen seen_in(const nlohmann::json& dump)
{
  Seen seen;
  for (const auto& edge : dump["edges"]) seen.n_messages += std::size_t{edge["message"].get<bool>()};
  for (const auto& task : dump["tasks"]) seen.ranks.insert(task["rank"].get<int>());
  return seen;
}

}  // namespace

TEST_CASE("the graph of one rank has no messages, and that of several has those between them")
{
  CHECK(seen_in(dump_on(1)).n_messages == 0);
  for (const int n_ranks : {2, 3}) {
    const Seen seen = seen_in(dump_on(n_ranks));
    CHECK(seen.n_messages > 0);
    CHECK(static_cast<int>(seen.ranks.size()) == n_ranks);
  }
}

TEST_CASE("ranks and patches that cannot be are refused, and so is a patch where none is drawn")
{
  const std::string graph = "graph " + scene;
  CHECK(tamp_with(graph + " --ranks 0").err == "tamp: --ranks: 0; expected 1 to 1024\n");
  CHECK_THAT(tamp_with(graph + " --patch 999").err, Catch::Contains("--patch: 999; expected a patch from 0 to "));
  CHECK(tamp_with(graph + " --patch 0 --format svg").err == "tamp: --patch: --format svg; expected --format dot\n");
  CHECK(tamp_with(graph + " --patch 0 --format svg").exit_code == 2);
}

TEST_CASE("a page of the graph has what a run of the scene took, and its longest chain")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string(), page = (folder.path() / "graph.html").string();
  const std::string graph = "graph " + scene + " --run " + run;
  CHECK_THAT(tamp_with(graph + " --format html").err, Catch::Contains("no run; expected the folder of a run"));
  REQUIRE(tamp_with("run " + scene + " --steps 20 --quiet --out " + run).exit_code == 0);

  REQUIRE(tamp_with(graph + " --format html --out " + page).exit_code == 0);

  const std::string text = read_text(page);
  const std::string opening = "id=\"folded\">";
  const std::size_t begin = text.find(opening) + opening.size();
  const auto folded = nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  double shares = 0;
  std::size_t n_critical = 0;
  for (const auto& task : folded["tasks"]) shares += task.value("/measured/share"_json_pointer, 0.0);
  for (const auto& edge : folded["edges"]) n_critical += std::size_t{edge.value("critical", false)};
  CHECK(shares > 0.9);  // but for the engine's own
  CHECK(n_critical > 3);
  CHECK(tamp_with(graph + " --format svg").err == "tamp: --run: --format svg; expected --format html or --threads\n");
}

TEST_CASE("no page and no replay is made of a run on other ranks, or of another scene", "[slow]")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string(), of_run = " --run " + run;
  REQUIRE(tamp_with("run " + scene + " --steps 20 --threads 1 --quiet --out " + run).exit_code == 0);
  const std::string form = GENERATE(" --format html", " --threads 2");
  const auto refused = [&](const std::string& graph, const std::string& words) {
    const Outcome outcome = tamp_with("graph " + graph + form + of_run);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::Contains(words));
  };

  refused(scene + " --ranks 2", "--ranks: 2; expected those of the run, 1");
  refused(TAMP_SOURCE_DIR "/inputs/footing/quick.json", "expected a run of this scene");
  refused(scene + " --set '/grid/patches=[4, 2]'", "expected a run of this scene");
}

TEST_CASE("a page is made of a run whose patches went to other ranks", "[mpiexec]")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  REQUIRE(tamp_on_ranks(2, "run " + scene + " --steps 20 --threads 1 --quiet --out " + run).exit_code == 0);
  auto profile = nlohmann::json::parse(read_text(folder.path() / "run" / "profile.json"));
  const std::string graph = "graph " + scene + " --ranks 2 --format html --run " + run;
  CHECK(tamp_with(graph).exit_code == 0);

  for (auto& patch : profile["patches"]) patch["rank"] = 1 - patch["rank"].get<int>();
  folder.write("run/profile.json", profile.dump());

  CHECK(tamp_with(graph).exit_code == 0);
}

TEST_CASE("a step is dealt to threads, and with a run of its scene told how fast it would be on them")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " + scene + " --steps 20 --threads 1 --quiet --out " + run).exit_code == 0);

  const Outcome dealt = tamp_with("graph " + scene + " --threads 3 --ranks 2");
  const Outcome timed = tamp_with("graph " + scene + " --threads 4 --run " + run);

  CHECK(dealt.exit_code == 0);
  CHECK_THAT(dealt.out, Catch::Contains("narrower than the 6 threads") && !Catch::Contains("by replay"));
  CHECK(timed.exit_code == 0);
  CHECK_THAT(timed.out, Catch::Contains("over mean") && Catch::Contains("us on 1, by replay"));
  CHECK_THAT(timed.out, Catch::Contains("\n      4 ") && Catch::Contains("the longest chain takes"));
  CHECK(tamp_with("graph " + scene + " --threads 4 --ranks 2 --run " + run).err ==
        "tamp: --ranks: 2; expected those of the run, 1\n");
  CHECK(tamp_with("graph " + scene + " --threads 0").exit_code == 2);
  CHECK(tamp_with("graph " + scene + " --threads 4 --format svg").exit_code == 2);
}

TEST_CASE("no step is replayed from a run that is another's, damaged or of an earlier version", "[slow]")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " + scene + " --steps 20 --threads 1 --quiet --out " + run).exit_code == 0);
  const auto profile = nlohmann::json::parse(read_text(folder.path() / "run" / "profile.json"));
  const auto outcome_with = [&](const nlohmann::json& changed, const std::string& options = "") {
    folder.write("run/profile.json", changed.dump());
    return tamp_with("graph " + scene + " --threads 4 --run " + run + options);
  };
  const auto without = [&](const char* key) {
    nlohmann::json changed = profile;
    changed.erase(key);
    return changed;
  };
  nlohmann::json longer = profile, shorter = profile, negative = profile;
  auto& times = shorter["mean_step"].begin().value();
  longer["mean_step"]["another task"] = times;
  negative["mean_step"].begin().value()[0][3] = -1e-6;
  times.erase(times.size() - 1);

  for (const auto& threads : {nlohmann::json(0), nlohmann::json(-1), nlohmann::json(2e9), nlohmann::json(300000)}) {
    nlohmann::json changed = profile;
    changed["machine"]["threads"] = threads;
    const Outcome damaged = outcome_with(changed);
    CHECK(damaged.exit_code == 4);
    CHECK_THAT(damaged.err, Catch::Contains("profile.json: is damaged"));
  }
  CHECK(outcome_with(negative).exit_code == 4);
  for (const Outcome& other :
       {outcome_with(longer), outcome_with(shorter), outcome_with(profile, " --set '/grid/patches=[4, 2]'")}) {
    CHECK(other.exit_code == 2);
    CHECK_THAT(other.err, Catch::Contains("expected a run of this scene"));
  }
  for (const char* key : {"machine", "mean_step"}) {
    const Outcome old = outcome_with(without(key));
    CHECK(old.exit_code == 2);
    CHECK_THAT(old.err, Catch::Contains("expected a run of this version of TAMP"));
  }
}

TEST_CASE("under a launcher the first rank alone writes the graph", "[mpiexec]")
{
  const Outcome alone = tamp_with("graph " + scene);

  const Outcome launched = tamp_on_ranks(2, "graph " + scene);

  CHECK(launched.exit_code == 0);
  CHECK(launched.out == alone.out);
}

}  // namespace test_graph_command
