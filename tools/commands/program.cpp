#include "tools/commands/program.hpp"

#include <sstream>

#include "tools/commands/commands.hpp"
#include "tools/console.hpp"
#include "tools/report_failure.hpp"
#include "tools/version.hpp"

namespace tamp::tools
{

int run_program(int argc, char** argv, const runtime::Communicator& ranks)
{
  CLI::App app("Material point simulations of things driven into sand, on a task graph.", "tamp");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();
  add_run_command(app);
  add_check_command(app);
  add_schema_command(app);
  add_graph_command(app);
  add_profile_command(app);
  add_drive_command(app);
  add_compare_command(app);
  add_modulus_command(app);
  add_study_command(app);
  add_bench_command(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    if (!runtime::Communicator::world().is_first()) return 0;
    std::ostringstream text;
    const int code = app.exit(asked, text);
    write_out(text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    return report_failure(error.what(), ExitCode::bad_input, ranks);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace tamp::tools
