#include "runtime/graph/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "runtime/graph/dump.hpp"
#include "runtime/graph/page_parts.hpp"
#include "runtime/graph/svg.hpp"

namespace tamp::runtime
{

namespace
{

/// The numbers of things in the order in which they first came.
template <class Thing>
class Numbers
{
 public:
  int of(const Thing& thing)
  {
    const auto [found, fresh] = numbers_.try_emplace(thing, static_cast<int>(things_.size()));
    if (fresh) things_.push_back(thing);
    return found->second;
  }
  const std::vector<Thing>& things() const { return things_; }

 private:
  std::map<Thing, int> numbers_;
  std::vector<Thing> things_;
};

/// Label, halo, bytes, and whether in a message: most edges of a graph share a few of these.
using Reason = std::tuple<int, int, std::size_t, int>;

void add_edges(const TaskGraph& graph, nlohmann::json& columns)
{
  Numbers<std::string> labels;
  Numbers<Reason> reasons;
  std::vector<int> to, back, reason;
  for (const Edge& e : graph.edges()) {
    to.push_back(e.to);
    back.push_back(e.to - e.from);
    reason.push_back(reasons.of({labels.of(e.label->name()), e.halo, e.bytes, int{e.message >= 0}}));
  }
  columns.update({{"edge_to", to},
                  {"edge_back", back},
                  {"edge_reason", reason},
                  {"reasons", reasons.things()},
                  {"labels", labels.things()}});
}

nlohmann::json columns_of(const TaskGraph& graph, const FoldedGraph& folded)
{
  std::vector<int> patch, rank, group;
  for (const Instance& instance : graph.instances()) {
    patch.push_back(instance.patch);
    rank.push_back(instance.rank);
    group.push_back(instance.group);
  }
  nlohmann::json columns = {{"task", folded.task_of},
                            {"patch", patch},
                            {"rank", rank},
                            {"group", group},
                            {"groups", graph.group_names()},
                            {"n_patches", graph.layout().n_patches()},
                            {"rank_of_patch", graph.layout().ranks()}};
  add_edges(graph, columns);
  return columns;
}

/// Adds what a run took to the tasks of the drawing, and marks the edges along its longest chain.
void add_measured(const nlohmann::json& profile, nlohmann::json& folded)
{
  std::map<std::string, int> number;
  for (nlohmann::json& task : folded["tasks"]) number.emplace(task["name"], static_cast<int>(number.size()));
  for (const nlohmann::json& measured : profile.at("tasks")) {
    const auto found = number.find(measured.at("name").get<std::string>());
    if (found == number.end()) continue;
    nlohmann::json& task = folded["tasks"][static_cast<std::size_t>(found->second)]["measured"];
    for (const char* key : {"count", "mean_s", "p95_s", "share", "imbalance", "chain_s", "on_chain",
                            "step_gain_if_a_tenth_faster", "step_gain_if_free"}) {
      if (measured.contains(key)) task[key] = measured[key].get<double>();
    }
  }
  std::set<std::pair<int, int>> along;
  int before = -1;
  for (const nlohmann::json& link : profile.at("longest_chain")) {
    const auto found = number.find(link.at("task").get<std::string>());
    const int now = found == number.end() ? -1 : found->second;
    if (before >= 0 && now >= 0) along.emplace(before, now);
    before = now;
  }
  for (nlohmann::json& edge : folded["edges"]) {
    if (along.contains({edge["from"].get<int>(), edge["to"].get<int>()})) edge["critical"] = true;
  }
}

/// JSON in a script element: nothing in it can end that.
std::string in_script(const char* id, const nlohmann::json& data)
{
  std::string safe;
  for (const char c : data.dump()) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, safe);
}

std::string counted(std::size_t n, const char* one, const char* more)
{
  return fmt::format("{} {}", n, n == 1 ? one : more);
}

std::string summary(const TaskGraph& graph, const FoldedGraph& folded)
{
  const auto n_patches = static_cast<std::size_t>(graph.layout().size());
  const auto n_ranks = static_cast<std::size_t>(graph.layout().n_ranks());
  return fmt::format("{} on {} and {}: {}, {}, {} in a step.", counted(folded.tasks.size(), "task", "tasks"),
                     counted(n_patches, "patch", "patches"), counted(n_ranks, "rank", "ranks"),
                     counted(graph.instances().size(), "instance", "instances"),
                     counted(graph.edges().size(), "edge", "edges"),
                     counted(graph.messages().size(), "message", "messages"));
}

constexpr const char* page_hint =
    "<p class=\"faint\">Point at a task or a line to see what it is for; choose it to hold that, and a task to see its "
    "instances. Boxes are tasks as declared, round ones the runtime's own work; what is dashed goes from rank to "
    "rank.</p>";

std::string times_hint(const nlohmann::json& profile)
{
  return fmt::format(
      "<p class=\"faint\">The darker a task, the more of the time of all tasks it took. A step took {:.4g} "
      "microseconds on average; the longest chain, drawn thick, {:.4g}.{}</p>",
      profile.at("step_s").get<double>() * 1e6, profile.at("longest_chain_s").get<double>() * 1e6,
      profile.value("too_busy", false) ? " The machine was too busy with other programs to trust these times." : "");
}

}  // namespace

std::size_t n_measured(const TaskGraph& graph, const nlohmann::json& profile)
{
  std::set<std::string> names;
  for (const nlohmann::json& task : profile.at("tasks")) names.insert(task.at("name").get<std::string>());
  const FoldedGraph folded = fold(graph);
  return static_cast<std::size_t>(
      std::ranges::count_if(folded.tasks, [&](const FoldedTask& task) { return names.contains(task.name); }));
}

std::string to_html(const TaskGraph& graph, const std::string& title, const nlohmann::json& profile)
{
  const FoldedGraph folded = fold(graph);
  nlohmann::json drawn = to_json(graph, folded);
  if (!profile.is_null()) add_measured(profile, drawn);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" href=\"data:,\">\n"
      "<title>{0}</title><style>{1}</style></head>\n<body><h1>{0}</h1>\n<p class=\"faint\">{2}</p>\n",
      in_markup(title), graph_page_style, summary(graph, folded));
  page += "<div class=\"search\"><input type=\"search\" aria-label=\"search\" placeholder=\"a task or a label\">";
  page += "<span class=\"hits faint\" role=\"status\"></span></div>\n<main><div class=\"drawing\">\n";
  page += to_svg(graph, folded);
  page += fmt::format("</div><aside class=\"resting\">{}{}</aside></main>\n", page_hint,
                      profile.is_null() ? "" : times_hint(profile));
  page += in_script("folded", drawn);
  page += in_script("instances", columns_of(graph, folded));
  return page + "<script>" + graph_page_script + "</script></body></html>\n";
}

}  // namespace tamp::runtime
