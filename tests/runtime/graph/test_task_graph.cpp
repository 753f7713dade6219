#include "runtime/graph/task_graph.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "runtime/graph/dump.hpp"

namespace tamp::runtime::test_task_graph
{

namespace
{

using Kind = GraphProblem::Kind;

const NodeLabel<double, "node mass"> mass;
const NodeLabel<double, "node velocity"> velocity;
const NodeLabel<double, "node acceleration"> acceleration;
const ParticleLabel<double, "weight"> weight;

const Grid line{2, {0, 0, 0}, 1, {12, 4, 1}};

auto nothing()
{
  return [](const TaskContext&, auto&&...) {};
}

TaskDeclaration gather(int halo)
{
  return task("gather").over_patches_and_groups().reads(weight.previous()).accumulates(mass.halo(halo)).body(nothing());
}

TaskDeclaration move(int halo)
{
  return task("move").over_patches_and_groups().reads(mass.halo(halo)).computes(velocity).body(nothing());
}

const HostData host{{&weight}, {&velocity}};

/// The problems that compiling these tasks over `n_patches` along x finds.
std::vector<GraphProblem> problems(std::vector<TaskDeclaration> tasks, const HostData& given = host, int n_patches = 2)
{
  const PatchLayout layout(line, {n_patches, 1, 1});
  try {
    TaskGraph(std::move(tasks), layout, {"only"}, given);
  } catch (const GraphError& error) {
    return error.problems;
  }
  return {};
}

/// Exactly one problem, of this kind, with this task and label.
void check_one(const std::vector<GraphProblem>& found, Kind kind, const std::string& name, const std::string& label)
{
  REQUIRE(found.size() == 1);
  CHECK(to_string(found[0].kind) == std::string(to_string(kind)));
  CHECK(found[0].task == name);
  CHECK(found[0].label == label);
}

}  // namespace

TEST_CASE("a sound graph has no problems", "[graph]")
{
  CHECK(problems({gather(1), move(1)}).empty());
}

TEST_CASE("a task that reads what none makes is a missing producer", "[graph]")
{
  const auto found = problems({move(0)});

  check_one(found, Kind::missing_producer, "move", "node mass");
}

TEST_CASE("a missing producer names the label that was probably meant", "[graph]")
{
  const NodeLabel<double, "node mas"> misspelt;
  auto wrong = task("move").over_patches_and_groups().reads(misspelt, mass).computes(velocity).body(nothing());

  const auto found = problems({gather(1), wrong});

  check_one(found, Kind::missing_producer, "move", "node mas");
  CHECK(found[0].explanation.find("did you mean 'node mass'?") != std::string::npos);
}

TEST_CASE("the step before can only be read of given state", "[graph]")
{
  auto wrong = task("move").over_patches_and_groups().reads(mass.previous()).computes(velocity).body(nothing());

  check_one(problems({wrong}), Kind::missing_producer, "move", "node mass");
}

TEST_CASE("two tasks that make one label are a double compute", "[graph]")
{
  auto twin = task("move again").over_patches_and_groups().reads(mass).computes(velocity).body(nothing());

  check_one(problems({gather(1), move(1), twin}), Kind::double_compute, "move again", "node velocity");
}

TEST_CASE("a task that makes what another accumulates is a double compute", "[graph]")
{
  auto make = task("make").over_patches_and_groups().computes(mass).body(nothing());

  check_one(problems({gather(1), move(1), make}), Kind::double_compute, "make", "node mass");
}

TEST_CASE("a task over patches cannot accumulate", "[graph]")
{
  auto wrong = task("gather").over_patches().accumulates(mass.every_group()).body(nothing());

  check_one(problems({wrong, move(0)}), Kind::bad_declaration, "gather", "node mass");
}

TEST_CASE("a global is made by a task over ranks, which uses nothing of patches", "[graph]")
{
  const GlobalLabel<double, "clock"> clock;
  const HostData of_clock{{&weight}, {&velocity, &clock}};
  const auto tick = task("tick").over_ranks().computes(clock).body(nothing());
  const auto by_patch = task("tick").over_patches().computes(clock).body(nothing());
  const auto changed = task("change").over_ranks().updates(clock).body(nothing());
  const auto heavy = task("tick").over_ranks().reads(mass).computes(clock).body(nothing());

  CHECK(problems({gather(1), move(1), tick}, of_clock).empty());
  check_one(problems({gather(1), move(1), by_patch}, of_clock), Kind::bad_declaration, "tick", "clock");
  check_one(problems({gather(1), move(1), tick, changed}, of_clock), Kind::bad_declaration, "change", "clock");
  check_one(problems({gather(1), move(1), heavy}, of_clock), Kind::bad_declaration, "tick", "node mass");
}

TEST_CASE("a task over ranks runs on each, after what makes its data and before what reads them", "[graph]")
{
  const ReductionLabel<double, "all"> all;
  const GlobalLabel<double, "clock"> clock;
  const auto sum = task("sum").over_patches_and_groups().reads(mass).reduces(all).body(nothing());
  const auto tick = task("tick").over_ranks().reads(all).computes(clock).body(nothing());
  const auto late = task("late").over_patches_and_groups().reads(mass, clock).computes(velocity).body(nothing());
  PatchLayout layout(line, {4, 1, 1});
  layout.give_to_ranks({0, 0, 1, 1}, 3);

  const TaskGraph graph({gather(1), sum, tick, late}, layout, {"only"}, host);

  std::vector<int> ranks;
  for (std::size_t i = 0; i < graph.instances().size(); ++i) {
    const Instance& instance = graph.instances()[i];
    const auto waits_for = [&](const std::string& name, int rank) {
      return std::any_of(instance.predecessors.begin(), instance.predecessors.end(), [&](int p) {
        const Instance& before = graph.instances()[static_cast<std::size_t>(p)];
        return graph.name(before) == name && before.rank == rank;
      });
    };
    if (graph.name(instance) == "tick") {
      ranks.push_back(instance.rank);
      CHECK(waits_for("combine: all", instance.rank));
    }
    if (graph.name(instance) == "late") CHECK(waits_for("tick", instance.rank));
  }
  std::sort(ranks.begin(), ranks.end());
  CHECK(ranks == std::vector<int>{0, 1, 2});
}

TEST_CASE("one sum follows all tasks that accumulate a label, as wide as the widest halo", "[graph]")
{
  auto load = task("load").over_patches_and_groups().accumulates(mass.halo(0)).body(nothing());
  const PatchLayout layout(line, {2, 1, 1});
  const TaskGraph graph({gather(1), load, move(1)}, layout, {"only"}, host);
  const auto& instances = graph.instances();

  const auto is_sum = [](const Instance& i) { return i.kind == InstanceKind::sum_halo; };
  CHECK(std::count_if(instances.begin(), instances.end(), is_sum) == 2);
  const auto sum = std::find_if(instances.begin(), instances.end(), is_sum);
  CHECK(sum->halo == 1);
  for (const int p : sum->predecessors) CHECK(graph.name(instances[static_cast<std::size_t>(p)]) == "load");
}

TEST_CASE("tasks that wait for each other are a cycle, told link by link", "[graph]")
{
  auto chicken = task("chicken").over_patches_and_groups().reads(acceleration).computes(velocity).body(nothing());
  auto egg = task("egg").over_patches_and_groups().reads(velocity).computes(acceleration).body(nothing());

  const auto found = problems({chicken, egg});

  REQUIRE(found.size() == 1);
  CHECK(found[0].kind == Kind::cycle);
  CHECK(found[0].explanation.find("'chicken' waits for 'egg' (node acceleration)") != std::string::npos);
  CHECK(found[0].explanation.find("which waits for 'chicken' (node velocity)") != std::string::npos);
}

TEST_CASE("a reader with a wider halo than the sum supplies is refused", "[graph]")
{
  const auto found = problems({gather(1), move(2)});

  check_one(found, Kind::halo_too_narrow, "move", "node mass");
  CHECK(found[0].explanation.find("reads a halo of 2") != std::string::npos);
}

TEST_CASE("a halo that reaches past a whole patch is too narrow a patch", "[graph]")
{
  check_one(problems({gather(1), move(1)}, host, 6), Kind::halo_too_narrow, "gather", "node mass");
}

TEST_CASE("a result that nobody reads is named", "[graph]")
{
  check_one(problems({gather(1), move(1)}, {{&weight}, {}}), Kind::unused_result, "move", "node velocity");
}

TEST_CASE("all problems are found at once", "[graph]")
{
  auto twin = task("move again").over_patches_and_groups().reads(acceleration).computes(velocity).body(nothing());

  const auto found = problems({gather(1), move(2), twin}, {{&weight}, {}});

  CHECK(found.size() == 4);
}

TEST_CASE("particles cannot be accumulated", "[graph]")
{
  auto wrong = task("gather").over_patches_and_groups().accumulates(weight).body(nothing());

  const auto found = problems({wrong}, {{}, {&weight}});

  REQUIRE(!found.empty());
  CHECK(found[0].kind == Kind::bad_declaration);
}

TEST_CASE("a halo sum waits for the parts of the patch and its neighbours, and no others", "[graph]")
{
  const PatchLayout layout(line, {4, 1, 1});
  const TaskGraph graph({gather(1), move(1)}, layout, {"only"}, host);
  const auto& instances = graph.instances();
  const auto sum = std::find_if(instances.begin(), instances.end(),
                                [](const Instance& i) { return i.kind == InstanceKind::sum_halo && i.patch == 1; });

  REQUIRE(sum != instances.end());
  REQUIRE(sum->predecessors.size() == 3);
  for (const int p : sum->predecessors) {
    CHECK(instances[static_cast<std::size_t>(p)].kind == InstanceKind::body);
    CHECK(instances[static_cast<std::size_t>(p)].patch <= 2);
  }
}

TEST_CASE("a reader before an update sees what was computed, and the update waits for it", "[graph]")
{
  auto use = task("use").over_patches_and_groups().reads(velocity).computes(acceleration).body(nothing());
  auto change = task("change").over_patches_and_groups().updates(velocity).body(nothing());
  const PatchLayout layout(line, {1, 1, 1});
  const TaskGraph graph({gather(1), move(1), use, change}, layout, {"only"}, {{&weight}, {&velocity, &acceleration}});
  const auto place = [&](const std::string& name) {
    const auto& all = graph.instances();
    return static_cast<int>(
        std::find_if(all.begin(), all.end(), [&](const Instance& i) { return graph.name(i) == name; }) - all.begin());
  };

  const auto& waits = graph.instances()[static_cast<std::size_t>(place("change"))].predecessors;

  CHECK(std::find(waits.begin(), waits.end(), place("use")) != waits.end());
  CHECK(std::find(waits.begin(), waits.end(), place("move")) != waits.end());
}

TEST_CASE("the dump has every instance and every edge", "[graph]")
{
  const PatchLayout layout(line, {4, 1, 1});
  const TaskGraph graph({gather(1), move(1)}, layout, {"only"}, host);

  const nlohmann::json dump = to_json(graph, 123);
  const std::string dot = to_dot(graph, 1);

  CHECK(dump["tasks"].size() == graph.instances().size());
  CHECK(dump["edges"].size() == graph.edges().size());
  CHECK(dump["memory"]["forecast_peak_bytes"] == 123);
  for (const auto& edge : dump["edges"]) CHECK(edge["from"] < edge["to"]);
  // The drawing of patch 1 has its gathering, its sum and its move, and the neighbours' gatherings and sums.
  for (const char* patch : {"patch 0", "patch 1", "patch 2"}) CHECK_THAT(dot, Catch::Contains(patch));
  CHECK_THAT(dot, !Catch::Contains("patch 3"));
}

TEST_CASE("what one rank needs of another for one purpose is one message, sent as soon as its data are there",
          "[graph]")
{
  PatchLayout layout(line, {4, 1, 1});
  layout.give_to_ranks({0, 0, 1, 1}, 2);
  const TaskGraph graph({gather(1), move(1)}, layout, {"only"}, host);

  // Patches 1 and 2 touch: each rank sends the part of the other's seam.
  REQUIRE(graph.messages().size() == 2);
  for (const Message& message : graph.messages()) {
    CHECK(message.purpose == InstanceKind::sum_halo);
    CHECK(message.parts.size() == 1);
    CHECK(message.bytes ==
          message.parts[0].label->value_bytes() * static_cast<std::size_t>(message.parts[0].box.size()));
    const Instance& send = graph.instances()[static_cast<std::size_t>(message.send)];
    CHECK(send.rank == message.from_rank);
    REQUIRE(send.predecessors.size() == 1);
    CHECK(graph.instances()[static_cast<std::size_t>(send.predecessors[0])].patch == message.parts[0].from_patch);
    const Instance& receive = graph.instances()[static_cast<std::size_t>(message.receive)];
    CHECK(receive.rank == message.to_rank);
    CHECK(receive.predecessors == std::vector<int>{message.send});
  }
  for (const Edge& edge : graph.edges()) {
    const Instance& from = graph.instances()[static_cast<std::size_t>(edge.from)];
    const Instance& to = graph.instances()[static_cast<std::size_t>(edge.to)];
    CHECK((from.rank == to.rank || (edge.message >= 0 && from.kind == InstanceKind::send_message)));
  }
}

}  // namespace tamp::runtime::test_task_graph
