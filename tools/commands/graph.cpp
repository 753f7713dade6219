#include <fmt/core.h>

#include <memory>
#include <stdexcept>

#include "runtime/graph/dump.hpp"
#include "runtime/graph/page.hpp"
#include "runtime/graph/svg.hpp"
#include "runtime/profile/dealt_step.hpp"
#include "runtime/profile/mean_step.hpp"
#include "runtime/profile/table.hpp"
#include "tasks/forecast/demand.hpp"
#include "tasks/step_graph.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/profile_text.hpp"
#include "tools/scene/files/output_file.hpp"
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
  std::string run;
  int n_ranks = 1;
  /// 0: the graph itself is wanted.
  int n_threads = 0;
  int patch = -1;
};

constexpr int most_ranks = 1024, most_threads = 1024;

void expect_patch(int patch, const std::string& format, int n_patches)
{
  if (patch < 0) return;
  if (format != "dot") throw InputError({"--patch", "--format " + format, "expected --format dot"});
  if (patch >= n_patches) {
    throw InputError({"--patch", std::to_string(patch), "expected a patch from 0 to " + std::to_string(n_patches - 1)});
  }
}

/// Earlier versions did not write all that tells one step from another.
void expect_mean_step(const nlohmann::json& profile, const std::string& run)
{
  if (profile.contains("machine") && profile.contains("mean_step")) return;
  throw InputError({"--run", run, "expected a run of this version of TAMP"});
}

void expect_ranks_of(const nlohmann::json& profile, int n_ranks)
{
  const double of_run = profile.at("machine").at("ranks").get<double>();
  if (of_run == n_ranks) return;
  throw InputError({"--ranks", std::to_string(n_ranks), fmt::format("expected those of the run, {:.0f}", of_run)});
}

/// Whether the tasks of a graph were measured one by one, or all of them by name where there were too many, or where
/// patches went to other ranks as the run went on.
bool is_step_of(const runtime::TaskGraph& graph, const nlohmann::json& profile)
{
  std::vector<int> ranks;
  for (const nlohmann::json& patch : profile.at("patches")) ranks.push_back(patch.at("rank").get<int>());
  if (ranks.size() != graph.layout().ranks().size()) return false;
  const bool one_by_one = !profile.at("mean_step").empty() && ranks == graph.layout().ranks();
  return one_by_one ? timed_step(graph, profile).has_value() : n_measured(graph, profile) == fold(graph).tasks.size();
}

/// The page, with what a run took if one is named.
std::string page_of(const runtime::TaskGraph& graph, const GraphArguments& options)
{
  const std::string title = "A time step of " + options.scene;
  if (options.run.empty()) return to_html(graph, title);
  return with_profile(options.run, [&](const nlohmann::json& profile) {
    expect_mean_step(profile, options.run);
    expect_ranks_of(profile, options.n_ranks);
    if (!is_step_of(graph, profile)) {
      throw InputError({"--run", options.run, "expected a run of this scene: it has other tasks than the graph"});
    }
    return to_html(graph, title, profile);
  });
}

int threads_of(const nlohmann::json& machine)
{
  const double n = machine.at("threads").get<double>();
  if (!(n >= 1 && n <= most_threads)) throw std::out_of_range("threads");
  return static_cast<int>(n);
}

/// As so many threads would have it; with what a run took, on how many how fast.
std::string threads_text(const runtime::TaskGraph& graph, const GraphArguments& options)
{
  if (options.run.empty()) return to_text(runtime::deal_to_threads(graph, options.n_threads));
  return with_profile(options.run, [&](const nlohmann::json& profile) {
    expect_mean_step(profile, options.run);
    expect_ranks_of(profile, options.n_ranks);
    const auto step = timed_step(graph, profile);
    if (!step) {
      throw InputError({"--run", options.run, "expected a run of this scene, of at most 20,000 tasks a step"});
    }
    return to_text(deal_to_threads(*step, options.n_threads)) +
           replays_text(*step, options.n_threads, threads_of(profile.at("machine")),
                        profile.at("step_s").get<double>()) +
           runtime::busy_text(profile);
  });
}

std::string text_of(const runtime::TaskGraph& graph, const tasks::Scene& scene, const GraphArguments& options)
{
  if (options.n_threads > 0) return threads_text(graph, options);
  if (options.format == "json") {
    return to_json(graph, static_cast<std::size_t>(tasks::demand_of(scene).fields)).dump(1) + "\n";
  }
  if (options.format == "html") return page_of(graph, options);
  if (options.format == "svg") return to_svg(graph, fold(graph));
  return options.patch < 0 ? to_dot(graph, fold(graph)) : to_dot(graph, options.patch);
}

void dump_graph(const GraphArguments& options)
{
  if (!options.run.empty() && options.format != "html" && options.n_threads == 0) {
    throw InputError({"--run", "--format " + options.format, "expected --format html or --threads"});
  }
  const CheckedScene scene = read_scene(options.scene, options.assignments);
  print_notes(scene.notes);
  expect_outputs({{"--out", options.out}});
  const tasks::StepGraph step(scene.scene, options.n_ranks);
  expect_patch(options.patch, options.format, step.graph().layout().size());
  const std::string text = text_of(step.graph(), scene.scene, options);
  if (options.out.empty()) {
    print_out("{}", text);
  } else {
    write_output({"--out", options.out}, text);
  }
}

}  // namespace

CLI::App* add_graph_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("graph", "Draw or dump the task graph of a scene's time step");
  const auto options = std::make_shared<GraphArguments>();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  add_assignments(*command, options->assignments, "scene");
  CLI::Option* const format =
      command->add_option("--format", options->format, "dot (for graphviz), json, html (a page) or svg")
          ->check(is_one_of({"dot", "json", "html", "svg"}));
  command->add_option("--ranks", options->n_ranks, "as so many ranks would have it, with their messages")
      ->check(is_whole_from_to(1, most_ranks));
  command
      ->add_option(
          "--run", options->run,
          "with the times that a run of the scene took, and its longest chain (html), or on how many threads it would "
          "be how fast (--threads)")
      ->type_name("RUN_DIR")
      ->check(is_not_empty());
  command->add_option("--out", options->out, "write to this file")->type_name("FILE");
  CLI::Option* const patch = command->add_option("--patch", options->patch, "only this patch and what it touches (dot)")
                                 ->check(is_whole_from(0))
                                 ->default_str("");
  command
      ->add_option("--threads", options->n_threads,
                   "in place of the graph, what so many threads of each rank have of it, and how much may run at once")
      ->check(is_whole_from_to(1, most_threads))
      ->default_str("")
      ->excludes(format)
      ->excludes(patch);
  command->footer(examples(
      {{"tamp graph inputs/punch/quick.json --format html --out graph.html",
        "a page: tasks, and behind each its patches"},
       {"tamp graph inputs/punch/quick.json --run runs/quick --format html --out graph.html",
        "the same, with what each task took in a run"},
       {"tamp graph inputs/punch/quick.json --ranks 2 --format svg --out graph.svg", "a drawing, with the messages"},
       {"tamp graph inputs/punch/quick.json --threads 4 --run runs/quick", "how fast a step would be on four threads"},
       {"tamp graph inputs/punch/quick.json --patch 0 | dot -Tsvg > patch.svg", "what one patch does in a step"},
       {"tamp graph inputs/punch/quick.json --format json --out graph.json", "for other programs"}}));
  command->callback([options] { dump_graph(*options); });
  return command;
}

}  // namespace tamp::tools
