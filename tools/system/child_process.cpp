#include "tools/system/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "tools/system/errors.hpp"
#include "tools/system/signals.hpp"

namespace tamp::tools
{

namespace
{

/// Arguments of exec, made before the fork: a child of a process with threads may not ask for memory.
struct ExecArguments {
  explicit ExecArguments(const Child& child)
      : file(child.program.empty() ? "/proc/self/exe" : child.program), texts(child.arguments)
  {
    texts.insert(texts.begin(), child.program.empty() ? "tamp" : child.program);
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
  }
  std::string file;
  std::vector<std::string> texts;
  std::vector<char*> pointers;
};

/// The limit of processor time of a child, within that of this program, which no child may raise.
rlimit limit_of(double seconds)
{
  rlimit own{RLIM_INFINITY, RLIM_INFINITY};
  getrlimit(RLIMIT_CPU, &own);
  if (!std::isfinite(seconds)) return own;
  const auto whole = static_cast<rlim_t>(std::clamp(std::ceil(seconds), 1.0, 1e9));
  // Time to write a checkpoint.
  return {std::min(whole, own.rlim_max), std::min(whole + 30, own.rlim_max)};
}

/// Holds all signals back while it lives. A child begins with its parent's handlers: one that only notes a signal, in
/// memory that is gone with exec, would lose the request to stop.
class SignalsHeldBack
{
 public:
  SignalsHeldBack()
  {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldBack() { release(); }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

  void release() const { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

[[noreturn]] void become(const ExecArguments& arguments, const char* errors, const rlimit& limit, pid_t parent,
                         const SignalsHeldBack& signals)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A signal that comes before the program handles it ends the program.
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGXCPU}) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  signals.release();
  const int out = open("/dev/null", O_WRONLY);
  const int err = *errors == '\0' ? STDERR_FILENO : open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const bool ready = getppid() == parent && out >= 0 && err >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
                     dup2(err, STDERR_FILENO) >= 0 && setrlimit(RLIMIT_CPU, &limit) == 0;
  if (ready) execvp(arguments.file.c_str(), arguments.pointers.data());
  _exit(127);
}

double seconds(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

pid_t start(const Child& child)
{
  const ExecArguments arguments(child);
  const std::string errors = child.errors.string();
  const pid_t parent = getpid();
  const SignalsHeldBack signals;
  const pid_t pid = fork();
  if (pid < 0) throw ResourceError(std::string("cannot start a process: ") + std::strerror(errno));
  if (pid == 0) become(arguments, errors.c_str(), limit_of(child.cpu_limit), parent, signals);
  return pid;
}

/// The children under way. Those that are left when it goes are asked to stop, and waited for.
class RunningChildren
{
 public:
  RunningChildren() = default;
  RunningChildren(const RunningChildren&) = delete;
  RunningChildren& operator=(const RunningChildren&) = delete;
  ~RunningChildren()
  {
    for (const Running& one : running_) kill(one.pid, SIGTERM);
    for (const Running& one : running_) waitpid(one.pid, nullptr, 0);
  }

  int size() const { return static_cast<int>(running_.size()); }

  void add(std::size_t index, const Child& child) { running_.push_back({index, start(child)}); }

  /// Takes out a child that has ended, if there is one.
  std::optional<std::pair<std::size_t, ChildEnd>> take_ended()
  {
    for (auto one = running_.begin(); one != running_.end(); ++one) {
      int status = 0;
      rusage usage{};
      if (wait4(one->pid, &status, WNOHANG, &usage) == 0) continue;
      ChildEnd end;
      end.user_s = seconds(usage.ru_utime);
      if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
      const std::size_t index = one->index;
      running_.erase(one);
      return std::pair{index, end};
    }
    return std::nullopt;
  }

 private:
  struct Running {
    std::size_t index;
    pid_t pid;
  };
  std::vector<Running> running_;
};

}  // namespace

std::string ChildEnd::description() const
{
  return signal != 0 ? "signal " + std::to_string(signal) : "exit code " + std::to_string(exit_code);
}

void run_children(const std::vector<Child>& children, int n_at_once, const AtEnd& at_end)
{
  const SignalWatch watch;
  RunningChildren running;
  // Looks often at first, as many children are short.
  constexpr std::chrono::microseconds first_pause{500}, longest_pause{50000};
  auto pause = first_pause;
  for (std::size_t next = 0; next < children.size() || running.size() > 0;) {
    for (; next < children.size() && running.size() < n_at_once; ++next) running.add(next, children[next]);
    const auto ended = running.take_ended();
    if (watch.received() != 0) throw Interrupted("stopped by a signal", watch.received());
    if (ended) {
      at_end(ended->first, ended->second);
      pause = first_pause;
    } else {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, longest_pause);
    }
  }
}

ChildEnd run_child(const Child& child)
{
  ChildEnd end;
  run_children({child}, 1, [&](std::size_t, const ChildEnd& its_end) { end = its_end; });
  return end;
}

std::string error_text_of(const Child& child)
{
  std::ifstream stream(child.errors);
  std::string text;
  for (std::string line; std::getline(stream, line);) {
    constexpr std::string_view prefix = "tamp: ";
    if (line.starts_with(prefix)) line.erase(0, prefix.size());
    if (line.starts_with("warning: ")) continue;
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

}  // namespace tamp::tools
