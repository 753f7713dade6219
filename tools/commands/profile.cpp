#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "runtime/profile/report.hpp"
#include "runtime/storage/file_error.hpp"
#include "tools/commands/commands.hpp"

namespace tamp::tools
{

namespace
{

struct ProfileArguments {
  std::string folder;
  std::string format = "text";
};

nlohmann::json read_profile(const std::filesystem::path& folder)
{
  const std::filesystem::path file = folder / "profile.json";
  std::ifstream stream(file);
  if (!stream) throw runtime::FileError(file, "cannot be opened; is this the folder of a run?");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw runtime::FileError(file, error.what());
  }
}

}  // namespace

CLI::App* add_profile_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("profile", "Show where the time of a run went");
  const auto options = std::make_shared<ProfileArguments>();
  command->add_option("RUN_DIR", options->folder, "the run's folder")->required();
  command->add_option("--format", options->format, "text or json")->check(CLI::IsMember({"text", "json"}));
  command->callback([options] {
    const nlohmann::json profile = read_profile(options->folder);
    fmt::print("{}", options->format == "json" ? profile.dump(1) + "\n" : runtime::to_text(profile));
  });
  return command;
}

}  // namespace tamp::tools
