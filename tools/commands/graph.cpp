#include <fmt/core.h>

#include <memory>

#include "runtime/graph/dump.hpp"
#include "runtime/graph/page.hpp"
#include "runtime/graph/svg.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/forecast/demand.hpp"
#include "tasks/step_graph.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/scene/output_file.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

struct GraphArguments {
  std::string scene;
  std::vector<std::string> assignments;
  std::string format = "dot";
  std::string out;
  int n_ranks = 1;
  int patch = -1;
};

constexpr int most_ranks = 1024;

void expect_patch(int patch, const std::string& format, int n_patches)
{
  if (patch < 0) return;
  if (format != "dot") throw InputError({"--patch", "--format " + format, "expected --format dot"});
  if (patch >= n_patches) {
    throw InputError({"--patch", std::to_string(patch), "expected a patch from 0 to " + std::to_string(n_patches - 1)});
  }
}

std::string text_of(const runtime::TaskGraph& graph, const tasks::Scene& scene, const GraphArguments& options)
{
  if (options.format == "json") {
    return to_json(graph, static_cast<std::size_t>(tasks::demand_of(scene).fields)).dump(1) + "\n";
  }
  if (options.format == "html") return to_html(graph, "A time step of " + options.scene);
  if (options.format == "svg") return to_svg(graph, fold(graph));
  return options.patch < 0 ? to_dot(graph, fold(graph)) : to_dot(graph, options.patch);
}

void dump_graph(const GraphArguments& options)
{
  const CheckedScene scene = read_scene(options.scene, options.assignments);
  print_notes(scene.notes);
  expect_outputs({{"--out", options.out}});
  const tasks::StepGraph step(scene.scene, options.n_ranks);
  expect_patch(options.patch, options.format, step.graph().layout().size());
  const std::string text = text_of(step.graph(), scene.scene, options);
  if (options.out.empty()) {
    print_out("{}", text);
  } else {
    runtime::write_whole_file(options.out, text);
  }
}

}  // namespace

CLI::App* add_graph_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("graph", "Draw or dump the task graph of a scene's time step");
  const auto options = std::make_shared<GraphArguments>();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  add_assignments(*command, options->assignments, "scene");
  command->add_option("--format", options->format, "dot (for graphviz), json, html (a page) or svg")
      ->check(is_one_of({"dot", "json", "html", "svg"}));
  command->add_option("--ranks", options->n_ranks, "as so many ranks would have it, with their messages")
      ->check(is_from_to(1, most_ranks));
  command->add_option("--out", options->out, "write to this file")->type_name("FILE");
  command->add_option("--patch", options->patch, "only this patch and what it touches (dot)")->check(is_whole_from(0));
  command->footer(examples(
      {{"tamp graph inputs/punch/quick.json --format html --out graph.html",
        "a page: tasks, and behind each its patches"},
       {"tamp graph inputs/punch/quick.json --ranks 2 --format svg --out graph.svg", "a drawing, with the messages"},
       {"tamp graph inputs/punch/quick.json --patch 0 | dot -Tsvg > patch.svg", "what one patch does in a step"},
       {"tamp graph inputs/punch/quick.json --format json --out graph.json", "for other programs"}}));
  command->callback([options] { dump_graph(*options); });
  return command;
}

}  // namespace tamp::tools
