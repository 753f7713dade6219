#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "runtime/execute/exchange.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/file_error.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/commands/commands.hpp"
#include "tools/errors.hpp"
#include "tools/settle.hpp"
#include "tools/signals.hpp"
#include "tools/version.hpp"

namespace
{

using tamp::runtime::Communicator;
using tamp::tools::ExitCode;
using tamp::tools::settle;

/// Only these commands share their work over ranks; any other is the first rank's alone.
bool is_for_all_ranks(int argc, char** argv)
{
  const std::string command = argc > 1 ? argv[1] : "";
  return command == "run" || command == "bench";
}

/// The ranks that work on a command.
Communicator ranks_of(int argc, char** argv)
{
  return is_for_all_ranks(argc, argv) ? Communicator::world() : Communicator{};
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
    return Communicator::world().is_first() ? app.exit(asked) : 0;
  } catch (const CLI::ParseError& error) {
    return settle(error.what(), ExitCode::bad_input, ranks_of(argc, argv));
  }
  return static_cast<int>(ExitCode::done);
}

int run_or_settle(int argc, char** argv)
{
  const Communicator ranks = ranks_of(argc, argv);
  if (ranks.size() == 1 && !Communicator::world().is_first()) return 0;
  try {
    return run_program(argc, argv);
  } catch (const tamp::tools::Interrupted& stop) {
    return settle(stop.what(), ExitCode{static_cast<int>(ExitCode::signal) + stop.signal}, ranks);
  } catch (const tamp::tools::InputError& error) {
    return settle(error.what(), ExitCode::bad_input, ranks);
  } catch (const tamp::tasks::SimulationError& error) {
    return settle(error.what(), ExitCode::bad_simulation, ranks);
  } catch (const tamp::runtime::FileError& error) {
    return settle(error.what(), ExitCode::bad_file, ranks);
  } catch (const tamp::runtime::OtherRankFailed&) {
    return settle("", ExitCode::fault, ranks);
  } catch (const std::exception& error) {
    return settle(error.what(), ExitCode::fault, ranks);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    const tamp::runtime::MpiSession session(argc, argv);
    return run_or_settle(argc, argv);
  } catch (const std::exception& error) {
    return settle(error.what(), ExitCode::fault, Communicator{});
  }
}
