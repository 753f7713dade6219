#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tamp::tools
{

/// How a process ended.
struct ChildEnd {
  /// -1 where a signal ended it.
  int exit_code = -1;
  /// 0 where it ended by itself.
  int signal = 0;
  /// Processor time outside the kernel [s].
  double user_s = 0;

  bool done() const { return exit_code == 0; }
  /// The end in words, such as "signal 9" or "exit code 127".
  std::string description() const;
};

/// A process of this program with other arguments, the command first, or of another `program`, which is looked for
/// where the shell does; one that cannot be started ends with exit code 127. Its standard output is dropped, and its
/// standard error goes to the file `errors`, or, where that is empty, to that of this program. It goes down with this
/// one. After `cpu_limit` [s] of processor time, in whole seconds, it gets SIGXCPU, at which a run keeps its state and
/// ends.
struct Child {
  std::vector<std::string> arguments;
  std::filesystem::path errors{"/dev/null"};
  /// Empty for this one.
  std::string program{};
  double cpu_limit = std::numeric_limits<double>::infinity();
};

/// Runs it and waits for its end. Throws ResourceError if it cannot be started, and Interrupted when a signal asks this
/// program to stop: the child has then ended too.
ChildEnd run_child(const Child& child);

/// Tells which child ended, and how.
using AtEnd = std::function<void(std::size_t, const ChildEnd&)>;

/// Runs them in their order, so many at once, and calls `at_end` for each when it ends. Throws as run_child does, and
/// what `at_end` throws; no child runs any longer then.
void run_children(const std::vector<Child>& children, int n_at_once, const AtEnd& at_end);

/// The child's error messages from its file `errors`, in one line, without warnings.
std::string error_text_of(const Child& child);

}  // namespace tamp::tools
