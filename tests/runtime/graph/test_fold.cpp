#include "runtime/graph/fold.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "runtime/graph/dump.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_fold
{

namespace
{

const Grid plate{2, {0, 0, 0}, 1.0 / 40, {40, 40, 1}};

/// The heat equation's graph on n x n patches, every second column of which is another rank's where there are two.
struct HeatGraph {
  HeatGraph(int n, int n_ranks)
      : layout(on_ranks({plate, {n, n, 1}}, n_ranks)),
        graph({test::Heat::diffusion(plate)}, layout, {"heat"}, {{&test::temperature, &test::Heat::total}, {}})
  {
  }

  static PatchLayout on_ranks(PatchLayout layout, int n_ranks)
  {
    std::vector<int> ranks;
    ranks.reserve(static_cast<std::size_t>(layout.size()));
    for (int i = 0; i < layout.size(); ++i) ranks.push_back(i % n_ranks);
    layout.give_to_ranks(ranks, n_ranks);
    return layout;
  }

  PatchLayout layout;
  TaskGraph graph;
};

/// "diffuse -> combine: total heat: total heat" and so on: all that is drawn but for numbers.
std::vector<std::string> drawn(const FoldedGraph& folded)
{
  std::vector<std::string> lines;
  for (const FoldedTask& task : folded.tasks) lines.push_back(task.name);
  for (const FoldedEdge& e : folded.edges) {
    const auto name = [&](int task) { return folded.tasks[static_cast<std::size_t>(task)].name; };
    std::string line = name(e.from) + " -> " + name(e.to) + ":";
    for (const FoldedLabel& l : e.labels) line += " " + l.label->name() + " " + std::to_string(l.halo);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

TEST_CASE("4 and 400 patches fold to the same tasks, edges, labels and halos", "[graph]")
{
  for (const int n_ranks : {1, 2}) {
    const HeatGraph few(2, n_ranks), many(20, n_ranks);

    const FoldedGraph folded = fold(few.graph);

    CHECK(drawn(folded) == drawn(fold(many.graph)));
    CHECK(folded.tasks.size() == (n_ranks == 1 ? 3 : 7));
  }
}

TEST_CASE("a folded edge has the sums of the edges that it stands for", "[graph]")
{
  const HeatGraph heat(20, 1);

  const FoldedGraph folded = fold(heat.graph);

  REQUIRE(drawn(folded) == std::vector<std::string>{"fill halo: temperature", "diffuse", "combine: total heat",
                                                    "fill halo: temperature -> diffuse: temperature 1",
                                                    "diffuse -> combine: total heat: total heat 0"});
  CHECK(folded.tasks[1].instances.size() == 400);
  CHECK(folded.tasks[1].groups == std::vector<int>{0});
  CHECK(folded.tasks[2].instances.size() == 1);
  CHECK(folded.tasks[2].groups.empty());
  CHECK(folded.edges[0].labels[0].n_edges == 400);
  CHECK(folded.edges[1].labels[0].n_edges == 400);
  CHECK(folded.edges[1].labels[0].bytes == 400 * sizeof(double));
}

TEST_CASE("edges and bytes are all counted, and what crosses ranks are the messages", "[graph]")
{
  const HeatGraph heat(20, 2);
  std::size_t n_edges = 0, n_bytes = 0, n_crossing = 0, folded_edges = 0, folded_bytes = 0, crossing_bytes = 0;
  for (const Edge& e : heat.graph.edges()) ++n_edges, n_bytes += e.bytes;
  std::size_t message_bytes = 0;
  for (const Message& message : heat.graph.messages()) message_bytes += message.bytes;

  for (const FoldedEdge& e : fold(heat.graph).edges) {
    for (const FoldedLabel& l : e.labels) {
      folded_edges += l.n_edges;
      folded_bytes += l.bytes;
      n_crossing += l.n_crossing;
      if (e.crosses()) crossing_bytes += l.bytes;
    }
  }

  CHECK(folded_edges == n_edges);
  CHECK(folded_bytes == n_bytes);
  CHECK(n_crossing == heat.graph.messages().size());
  CHECK(message_bytes > 0);
  CHECK(crossing_bytes == message_bytes);
}

TEST_CASE("the dumps of the folded graph have each task and each edge once", "[graph]")
{
  const HeatGraph heat(20, 2);
  const FoldedGraph folded = fold(heat.graph);

  const nlohmann::json dump = to_json(heat.graph, 0)["folded"];
  const std::string dot = to_dot(heat.graph, folded);

  CHECK(dump["tasks"].size() == folded.tasks.size());
  CHECK(dump["tasks"][static_cast<std::size_t>(folded.task_of[0])]["name"] ==
        heat.graph.name(heat.graph.instances()[0]));
  REQUIRE(dump["edges"].size() == folded.edges.size());
  for (std::size_t i = 0; i < folded.edges.size(); ++i) {
    CHECK(dump["edges"][i]["from"] == folded.edges[i].from);
    CHECK(dump["edges"][i]["labels"][0]["edges"] == folded.edges[i].labels[0].n_edges);
    CHECK_THAT(dot, Catch::Contains("t" + std::to_string(folded.edges[i].from) + " -> t" +
                                    std::to_string(folded.edges[i].to) + " "));
  }
  CHECK_THAT(dot, Catch::Contains("label=\"diffuse\\n400 times for heat\""));
  CHECK(static_cast<std::size_t>(std::count(dot.begin(), dot.end(), '>')) == folded.edges.size());
  CHECK_THAT(dot, Catch::Contains("style=dashed"));
}

}  // namespace tamp::runtime::test_fold
