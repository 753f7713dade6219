#include <fmt/core.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/keys/schema.hpp"
#include "tools/system/console.hpp"

namespace tamp::tools
{

CLI::App* add_schema_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("schema", "Print the JSON schema of scenes, for editors and validators");
  const auto format = std::make_shared<std::string>("json");
  command->add_option("--format", *format, "json, or markdown: the keys as the tables of docs/reference/scene.md")
      ->check(is_one_of({"json", "markdown"}));
  command->footer(examples({{"tamp schema > scene.schema.json", "for an editor that completes and checks scenes"}}));
  command->callback([format] {
    print_out("{}",
              *format == "json" ? printed(scene_schema()) + "\n" : fmt::format("{}", fmt::join(key_tables(), "\n")));
  });
  return command;
}

}  // namespace tamp::tools
