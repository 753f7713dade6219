#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "runtime/file_error.hpp"
#include "runtime/profile/report.hpp"
#include "tools/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/option_checks.hpp"
#include "tools/console.hpp"
#include "tools/scene/parse_json.hpp"

namespace tamp::tools
{

namespace
{

struct ProfileArguments {
  std::string folder;
  std::string format = "text";
};

/// What is wrong with a profile that is JSON, for the library's own text.
std::string damage(const nlohmann::json::exception& error)
{
  constexpr int key_not_found = 403;
  const std::string text = error.what();
  const std::size_t begin = text.find('\''), end = text.rfind('\'');
  if (error.id != key_not_found || begin == end) return "a value is not what it was written as";
  return fmt::format("the key \"{}\" is missing", text.substr(begin + 1, end - begin - 1));
}

/// The profile of a run, as it was written or as text.
std::string told(const ProfileArguments& options)
{
  const std::filesystem::path file = std::filesystem::path(options.folder) / "profile.json";
  if (!std::filesystem::exists(file)) throw InputError({file.string(), "no such file", "expected the folder of a run"});
  try {
    const nlohmann::json profile = parse_json(file);
    return options.format == "json" ? profile.dump(1) + "\n" : runtime::to_text(profile);
  } catch (const InputError& error) {
    throw runtime::FileError(file, std::string("is damaged: ") + error.what());
  } catch (const nlohmann::json::exception& error) {
    throw runtime::FileError(file, "is damaged: " + damage(error) + "; expected what a run has written");
  }
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
  command->callback([options] { print_out("{}", told(*options)); });
  return command;
}

}  // namespace tamp::tools
