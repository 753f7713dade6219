#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "runtime/graph/page.hpp"
#include "runtime/graph/svg.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_graph_page
{

namespace
{

const Grid plate{2, {0, 0, 0}, 1.0 / 4, {4, 4, 1}};

TaskGraph graph_with(const PatchLayout& layout, const std::string& group)
{
  return {{test::Heat::diffusion(plate)}, layout, {group}, {{&test::temperature, &test::Heat::total}, {}}};
}

std::size_t n_of(const std::string& part, const std::string& text)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a drawing has a box for each task and a line for each edge, dashed from rank to rank", "[graph]")
{
  PatchLayout layout(plate, {2, 2, 1});
  layout.give_to_ranks({0, 0, 1, 1}, 2);
  const TaskGraph graph = graph_with(layout, "heat");
  const FoldedGraph folded = fold(graph);

  const std::string svg = to_svg(graph, folded);

  CHECK(n_of("<rect ", svg) == folded.tasks.size());
  CHECK(n_of("class=\"head\"", svg) == folded.edges.size());
  CHECK(n_of("class=\"edge message\"", svg) == 2);  // of the halo and of the total
  CHECK(n_of("class=\"task declared\"", svg) == 1);
  CHECK(n_of("class=\"task message\"", svg) == 4);
  CHECK(svg == to_svg(graph, fold(graph)));
}

TEST_CASE("no name breaks out of a drawing or a page", "[graph]")
{
  const PatchLayout layout(plate, {2, 2, 1});
  const TaskGraph graph = graph_with(layout, "</script><b>\"&\x01");

  const std::string svg = to_svg(graph, fold(graph));
  const std::string page = to_html(graph, "<i>&");

  CHECK_THAT(svg, Catch::Contains("&lt;/script&gt;&lt;b&gt;&quot;&amp; "));
  CHECK_THAT(page, Catch::Contains("<title>&lt;i&gt;&amp;</title>"));
  CHECK(n_of("<b>", page) == 0);
  CHECK(n_of("</script>", page) == 3);  // tasks, instances, and what the page does
}

}  // namespace tamp::runtime::test_graph_page
