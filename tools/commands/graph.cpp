#include <fmt/core.h>

#include <memory>

#include "runtime/graph/dump.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation.hpp"
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
  int patch = -1;
};

void dump_graph(const GraphArguments& options)
{
  const CheckedScene scene = read_scene(options.scene, options.assignments);
  print_notes(scene.notes);
  expect_outputs({{"--out", options.out}});
  const auto simulation = tasks::Simulation::make(scene.scene, 1);
  const runtime::TaskGraph& graph = simulation->engine().graph();
  if (options.patch >= graph.layout().size()) {
    throw InputError(
        {"--patch", std::to_string(options.patch), "a patch from 0 to " + std::to_string(graph.layout().size() - 1)});
  }
  const std::string text = options.format == "json" ? to_json(graph, simulation->forecast_bytes()).dump(1) + "\n"
                                                    : to_dot(graph, options.patch);
  if (options.out.empty()) {
    print_out("{}", text);
  } else {
    runtime::write_whole_file(options.out, text);
  }
}

}  // namespace

CLI::App* add_graph_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("graph", "Dump the task graph of a scene's time step");
  const auto options = std::make_shared<GraphArguments>();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  add_assignments(*command, options->assignments, "scene");
  command->add_option("--format", options->format, "dot, for graphviz, or json")->check(is_one_of({"dot", "json"}));
  command->add_option("--out", options->out, "write to this file")->type_name("FILE");
  command->add_option("--patch", options->patch, "only this patch and what it touches (dot)")->check(is_whole_from(0));
  command->footer(examples(
      {{"tamp graph inputs/punch/quick.json --patch 0 | dot -Tsvg > graph.svg", "what one patch does in a step"},
       {"tamp graph inputs/punch/quick.json --format json --out graph.json", "for other programs"}}));
  command->callback([options] { dump_graph(*options); });
  return command;
}

}  // namespace tamp::tools
