#include <exception>
#include <new>
#include <string>

#include "runtime/execute/exchange.hpp"
#include "runtime/file_error.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/hdf5.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/commands/program.hpp"
#include "tools/console.hpp"
#include "tools/errors.hpp"
#include "tools/machine_room.hpp"
#include "tools/report_failure.hpp"
#include "tools/run/signals.hpp"

namespace
{

using tamp::runtime::Communicator;
using tamp::tools::ExitCode;
using tamp::tools::report_failure;

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

int run_or_report(int argc, char** argv)
{
  const Communicator ranks = ranks_of(argc, argv);
  if (ranks.size() == 1 && !Communicator::world().is_first()) return 0;
  try {
    const int code = tamp::tools::run_program(argc, argv, ranks);
    tamp::tools::flush_out();
    return code;
  } catch (const tamp::tools::Interrupted& stop) {
    return report_failure(stop.what(), ExitCode{static_cast<int>(ExitCode::signal) + stop.signal}, ranks);
  } catch (const tamp::tools::InputError& error) {
    return report_failure(error.what(), ExitCode::bad_input, ranks);
  } catch (const tamp::tasks::SimulationError& error) {
    return report_failure(error.what(), ExitCode::bad_simulation, ranks);
  } catch (const tamp::runtime::FileError& error) {
    return report_failure(error.what(), ExitCode::no_resources, ranks);
  } catch (const tamp::runtime::OtherRankFailed&) {
    return report_failure("", ExitCode::no_resources, ranks);
  } catch (const std::bad_alloc&) {
    return report_failure("out of memory", ExitCode::no_resources, ranks);
  } catch (const std::exception& error) {
    return report_failure(error.what(), ExitCode::no_resources, ranks);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  tamp::tools::guard_console();
  tamp::tools::give_back_freed_memory();
  tamp::runtime::hdf5::close_nothing_at_exit();
  try {
    const tamp::runtime::MpiSession session(argc, argv);
    return run_or_report(argc, argv);
  } catch (const std::exception& error) {
    return report_failure(error.what(), ExitCode::no_resources, Communicator{});
  }
}
