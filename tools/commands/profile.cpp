#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/profile_text.hpp"
#include "tools/system/charts.hpp"
#include "tools/system/console.hpp"

namespace tamp::tools
{

namespace
{

struct ProfileArguments {
  std::string folder;
  std::string format = "text";
};

void show_profile(const ProfileArguments& options)
{
  const std::filesystem::path folder = options.folder, file = folder / "profile.json";
  if (options.format == "json") {
    print_out("{}", profile_json_text(file));
    return;
  }
  // Read in any case: where the run left none, or a damaged one, this says so.
  const std::string text = profile_text(file);
  if (options.format == "text") {
    print_out("{}", text);
    return;
  }
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
  command->footer(
      examples({{"tamp profile runs/punch", "the tasks, the most expensive first"},
                {"tamp profile runs/punch --format json", "as it was written"},
                {"tamp profile runs/punch --format html", "runs/punch/report.html, with the run's plots"}}));
  command->callback([options] { show_profile(*options); });
  return command;
}

}  // namespace tamp::tools
