#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/profile_text.hpp"
#include "tools/system/console.hpp"

namespace tamp::tools
{

namespace
{

struct ProfileArguments {
  std::string folder;
  std::string format = "text";
};

/// The profile of a run, as it was written or as text.
std::string profile_of(const ProfileArguments& options)
{
  const std::filesystem::path file = std::filesystem::path(options.folder) / "profile.json";
  return options.format == "json" ? profile_json_text(file) : profile_text(file);
}

}  // namespace

CLI::App* add_profile_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("profile", "Show where the time of a run went");
  const auto options = std::make_shared<ProfileArguments>();
  command->add_option("RUN_DIR", options->folder, "the run's folder")->type_name("DIR")->required();
  command->add_option("--format", options->format, "text or json")->check(is_one_of({"text", "json"}));
  command->footer(examples({{"tamp profile runs/punch", "the tasks, the most expensive first"},
                            {"tamp profile runs/punch --format json", "as it was written"}}));
  command->callback([options] { print_out("{}", profile_of(*options)); });
  return command;
}

}  // namespace tamp::tools
