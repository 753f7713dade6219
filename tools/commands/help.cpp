#include <memory>
#include <string>
#include <vector>

#include "tools/commands/command_line/completion.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/known_words.hpp"
#include "tools/commands/command_line/man_page.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/command_line/option_words.hpp"
#include "tools/commands/commands.hpp"
#include "tools/system/console.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools
{

/// Prints help of the program, or of the command that these words lead to.
CLI::App* add_help_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("help", "Print the help of a command, or of the program");
  const auto names = std::make_shared<std::vector<std::string>>();
  command->add_option("COMMAND", *names, "as in tamp help run");
  command->footer(examples({{"tamp help run", "all that tamp run takes"}}));
  command->callback([&app, names] {
    print_out("{}", HelpFormatter().make_help(&command_named(app, *names), "", CLI::AppFormatMode::Normal));
  });
  return command;
}

CLI::App* add_version_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("version", "Print the version, the build, and that of every library");
  command->footer(examples({{"tamp version", "the same as tamp --version"}}));
  command->callback([] { print_out("{}\n", version_text()); });
  return command;
}

CLI::App* add_completion_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("completion", "Print a shell completion script");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "the shell")->required()->check(is_one_of({"bash", "zsh"}));
  command->footer(examples({{"source <(tamp completion bash)", "for this shell"},
                            {"tamp completion zsh > ~/.zfunc/_tamp", "for a folder that is in zsh's fpath"}}));
  command->callback([&app, shell] { print_out("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app)); });
  return command;
}

CLI::App* add_man_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("man", "Print the manual page");
  command->footer(examples({{"tamp man > tamp.1 && man ./tamp.1", "to read it"}}));
  command->callback([&app] { print_out("{}", man_page(app)); });
  return command;
}

}  // namespace tamp::tools
