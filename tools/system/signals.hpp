#pragma once

#include <stdexcept>
#include <string>

#include "runtime/execute/executor.hpp"

namespace tamp::tools
{

/// A run that ended early because a signal or a limit asked it to, with its state kept.
struct Interrupted : std::runtime_error {
  Interrupted(const std::string& what, int signal_) : std::runtime_error(what), signal(signal_) {}
  int signal;
};

/// From here on a SIGUSR2 is noted and SIGUSR1 does nothing, as a run has not begun to watch.
void note_early_signals();

/// While it lives, SIGTERM, SIGINT, SIGHUP and SIGXCPU are noted instead of ending the program, SIGUSR2, which mpirun
/// hands on at once, counts as SIGTERM, and SIGUSR1 has the executor, if there is one, say what it is at. A SIGHUP that
/// was ignored, as under nohup, stays ignored. One at a time.
class SignalWatch
{
 public:
  explicit SignalWatch(runtime::Executor& executor) : SignalWatch(&executor) {}
  SignalWatch() : SignalWatch(nullptr) {}
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The last signal that asked to stop; 0 for none.
  int received() const;

 private:
  explicit SignalWatch(runtime::Executor* executor);
};

}  // namespace tamp::tools
