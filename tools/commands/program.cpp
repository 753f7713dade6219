#include "tools/commands/program.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <vector>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/known_words.hpp"
#include "tools/commands/commands.hpp"
#include "tools/system/console.hpp"
#include "tools/system/report_failure.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools
{

namespace
{

/// `tamp bench verify`, as `tamp verify` was written up to version 0.1.
bool is_old_verify(int argc, char** argv)
{
  return argc > 2 && argv[1] == std::string("bench") && argv[2] == std::string("verify");
}

}  // namespace

int run_program(int argc, char** argv, const runtime::Communicator& ranks)
{
  CLI::App app("Material point simulations of things driven into sand, on a task graph.", "tamp");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormatter>());
  app.option_defaults()->always_capture_default();
  add_new_command(app);
  add_run_command(app);
  add_check_command(app);
  add_schema_command(app);
  add_graph_command(app);
  add_profile_command(app);
  add_plot_command(app);
  add_drive_command(app);
  add_compare_command(app);
  add_modulus_command(app);
  add_study_command(app);
  add_verify_command(app);
  add_stability_command(app);
  add_bench_command(app);
  add_help_command(app);
  add_version_command(app);
  add_completion_command(app);
  add_man_command(app);
  app.footer(examples({{"tamp new ball ball.json", "a scene to start from"},
                       {"tamp run inputs/punch/quick.json", "the punch, into runs/quick"},
                       {"tamp help run", "all options of a command, with examples"}}));

  if (is_old_verify(argc, argv)) {
    if (runtime::Communicator::world().is_first()) print_err("tamp bench verify is now tamp verify\n");
    --argc, ++argv;
  }
  try {
    expect_known_words(app, {argv + 1, argv + argc});
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    if (!runtime::Communicator::world().is_first()) return 0;
    std::ostringstream text;
    const int code = app.exit(asked, text);
    write_out(text.str());
    return code;
  } catch (const CLI::RequiredError& missing) {
    return report_failure(fmt::format("{}; see tamp help {}", missing.what(), argv[1]), ExitCode::bad_input, ranks);
  } catch (const CLI::ExtrasError& extra) {
    return report_failure(fmt::format("{}; see tamp help {}", extra.what(), argv[1]), ExitCode::bad_input, ranks);
  } catch (const CLI::ParseError& error) {
    return report_failure(error.what(), ExitCode::bad_input, ranks);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace tamp::tools
