#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/execute/exchange.hpp"
#include "runtime/file_error.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/hdf5.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/commands/program.hpp"
#include "tools/system/capacity.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/report_failure.hpp"
#include "tools/system/signals.hpp"

namespace
{

using tamp::runtime::Communicator;
using tamp::tools::ExitCode;
using tamp::tools::report_failure;

std::atomic<bool> memory_ran_out{false};
std::terminate_handler usual_end = nullptr;

[[noreturn]] void note_and_throw()
{
  memory_ran_out = true;
  throw std::bad_alloc();
}

/// Where memory runs out and nothing can catch it: before main, in what must not throw, in a library's thread.
[[noreturn]] void end_without_memory()
{
  if (memory_ran_out) {
    constexpr std::string_view text = "tamp: out of memory\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    _exit(static_cast<int>(ExitCode::no_resources));
  }
  usual_end();
  std::abort();
}

/// Called before the objects of namespaces are made, many of which allocate.
[[gnu::constructor(101)]] void guard_memory()
{
  std::set_new_handler(note_and_throw);
  usual_end = std::set_terminate(end_without_memory);
}

/// Only these commands share their work over ranks; any other is the first rank's alone.
bool is_for_all_ranks(int argc, char** argv)
{
  const std::string command = argc > 1 ? argv[1] : "";
  return command == "run" || command == "bench";
}

/// Ranks that were given different work would wait for each other without end.
void expect_same_arguments(int argc, char** argv)
{
  const Communicator world = Communicator::world();
  if (world.size() == 1) return;
  std::string own;
  for (int i = 1; i < argc; ++i) own.append(argv[i]).push_back('\0');
  const std::vector<std::string> of_each = world.gather(own);
  const auto other = std::find_if(of_each.begin(), of_each.end(), [&](const auto& a) { return a != of_each.front(); });
  if (other == of_each.end()) return;
  throw tamp::tools::InputError({fmt::format("rank {}", other - of_each.begin()),
                                 "other arguments than those of rank 0", "expected the same on all ranks"});
}

/// The ranks that work on a command.
Communicator ranks_of(int argc, char** argv)
{
  return is_for_all_ranks(argc, argv) ? Communicator::world() : Communicator{};
}

int run_or_report(int argc, char** argv)
{
  Communicator ranks = Communicator::world();
  try {
    expect_same_arguments(argc, argv);
    ranks = ranks_of(argc, argv);
    if (ranks.size() == 1 && !Communicator::world().is_first()) return 0;
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
