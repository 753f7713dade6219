#include <cstdio>
#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "runtime/storage/file_error.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/commands/commands.hpp"
#include "tools/errors.hpp"
#include "tools/version.hpp"

namespace
{

using tamp::tools::ExitCode;

/// Every line of `text` on stderr, each with the program's name before it.
int complain(const std::string& text, ExitCode code)
{
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    fmt::print(stderr, "tamp: {}\n", text.substr(begin, end - begin));
    begin = end + 1;
  }
  return static_cast<int>(code);
}

int run_program(int argc, char** argv)
{
  CLI::App app("Material point simulations of things driven into sand, on a task graph.", "tamp");
  app.set_version_flag("--version", tamp::tools::version_text());
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();
  tamp::tools::add_run_command(app);
  tamp::tools::add_check_command(app);
  tamp::tools::add_graph_command(app);
  tamp::tools::add_profile_command(app);
  tamp::tools::add_drive_command(app);
  tamp::tools::add_compare_command(app);
  tamp::tools::add_modulus_command(app);
  tamp::tools::add_bench_command(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    return complain(error.what(), ExitCode::bad_input);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    return run_program(argc, argv);
  } catch (const tamp::tools::InputError& error) {
    return complain(error.what(), ExitCode::bad_input);
  } catch (const tamp::tasks::SimulationError& error) {
    return complain(error.what(), ExitCode::bad_simulation);
  } catch (const tamp::runtime::FileError& error) {
    return complain(error.what(), ExitCode::bad_file);
  } catch (const std::exception& error) {
    return complain(error.what(), ExitCode{1});
  }
}
