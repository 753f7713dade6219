#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "tools/bench/triad.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/page_data.hpp"
#include "tools/run/profile_text.hpp"
#include "tools/run/run_machine.hpp"
#include "tools/system/charts.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

struct ProfileArguments {
  std::string folder;
  std::string format = "text";
  std::string other;
  ProfileView view;
};

/// Pages have all, and JSON has all or a comparison.
void expect_text(const ProfileArguments& options)
{
  const ProfileView& view = options.view;
  const bool is_part = !view.phase.empty() || !view.ranks.empty() || view.patches || view.chain || view.memory;
  const bool is_other = !options.other.empty() && options.format == "html";
  if (options.format == "text" || !(is_part || is_other)) return;
  throw InputError({"--format", options.format + " of a part of the profile",
                    options.format == "json" ? "expected it of all, or with --compare alone" : "expected it of all"});
}

/// Measured now, where the run was made on this machine.
double memory_rate_of(const nlohmann::json& profile)
{
  const auto machine = profile.find("machine");
  if (machine == profile.end() || !is_this_machine(*machine)) return 0;
  const double workers = machine->at("ranks").get<double>() * machine->at("threads").get<double>();
  const int cores = usable_cores().of_machine;
  return bench::triad_bytes_per_second_each(static_cast<int>(std::clamp(workers, 1.0, static_cast<double>(cores))));
}

void show_profile(ProfileArguments& options)
{
  expect_text(options);
  const std::filesystem::path folder = options.folder;
  if (!options.other.empty()) options.view.other = options.other;
  options.view.memory_rate = memory_rate_of;
  options.view.as_json = options.format == "json";
  // Read in any case: where the run left none, or a damaged one, this says so.
  const std::string text = profile_text(folder, options.view);
  if (options.format != "html") {
    print_out("{}", text);
    return;
  }
  expect_page(folder);
  write_page_data(folder);
  draw_page(folder);
  print_out("written to {}\n", (folder / "report.html").string());
}

}  // namespace

CLI::App* add_profile_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("profile", "Show where the time of a run went, and how it ended");
  const auto options = std::make_shared<ProfileArguments>();
  command->add_option("RUN_DIR", options->folder, "the run's folder")->type_name("DIR")->required();
  command->add_option("--format", options->format, "text, json, or html: the page of the run")
      ->check(is_one_of({"text", "json", "html"}));
  CLI::Option* const phase =
      command->add_option("--phase", options->view.phase, "only tasks of this phase: what stands before the colon")
          ->type_name("NAME")
          ->check(is_not_empty());
  CLI::Option* const rank = command->add_option("--rank", options->view.ranks, "a table of each of these ranks")
                                ->type_name("R,R...")
                                ->delimiter(',')
                                ->check(is_whole_from(0));
  CLI::Option* const patches =
      command->add_flag("--patches", options->view.patches, "the costliest patches")->excludes(rank)->excludes(phase);
  CLI::Option* const chain = command
                                 ->add_flag("--chain", options->view.chain,
                                            "the longest chain of tasks and messages, which bounds the step from below")
                                 ->excludes(rank)
                                 ->excludes(phase)
                                 ->excludes(patches);
  CLI::Option* const memory =
      command->add_flag("--memory", options->view.memory, "memory by label and by task, when it was largest")
          ->excludes(rank)
          ->excludes(phase)
          ->excludes(patches)
          ->excludes(chain);
  command
      ->add_option("--compare", options->other, "task by task with another run, and which differences exceed the noise")
      ->type_name("RUN_DIR")
      ->check(is_not_empty())
      ->excludes(rank)
      ->excludes(patches)
      ->excludes(chain)
      ->excludes(memory);
  command->footer(
      examples({{"tamp profile runs/punch", "the tasks, the most expensive first"},
                {"tamp profile runs/punch --patches", "which patches take longest"},
                {"tamp profile runs/svr --compare runs/table", "what another model costs, task by task"},
                {"tamp profile runs/punch --format json", "as it was written"},
                {"tamp profile runs/punch --format html", "runs/punch/report.html, with the run's plots"}}));
  command->callback([options] { show_profile(*options); });
  return command;
}

}  // namespace tamp::tools
