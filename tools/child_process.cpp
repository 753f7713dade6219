#include "tools/child_process.hpp"

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
#include <thread>

#include "tools/errors.hpp"
#include "tools/run/signals.hpp"

namespace tamp::tools
{

namespace
{

/// What exec takes, made before the fork: a child of a process with threads may not ask for memory.
struct ExecArguments {
  explicit ExecArguments(const std::vector<std::string>& arguments) : texts(arguments)
  {
    texts.insert(texts.begin(), "tamp");
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
  }
  std::vector<std::string> texts;
  std::vector<char*> pointers;
};

rlimit limit_of(double seconds)
{
  if (!std::isfinite(seconds)) return {RLIM_INFINITY, RLIM_INFINITY};
  const auto whole = static_cast<rlim_t>(std::clamp(std::ceil(seconds), 1.0, 1e9));
  // Time to write a checkpoint.
  return {whole, whole + 30};
}

[[noreturn]] void become(const ExecArguments& arguments, const char* errors, const rlimit& limit, pid_t parent)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // What comes before the program watches for itself ends it.
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGXCPU}) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  const int out = open("/dev/null", O_WRONLY);
  const int err = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const bool ready = getppid() == parent && out >= 0 && err >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
                     dup2(err, STDERR_FILENO) >= 0 && setrlimit(RLIMIT_CPU, &limit) == 0;
  if (ready) execv("/proc/self/exe", arguments.pointers.data());
  _exit(127);
}

double seconds(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildEnd run_child(const Child& child)
{
  const ExecArguments arguments(child.arguments);
  const std::string errors = child.errors.string();
  const SignalWatch watch;
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw ResourceError(std::string("cannot start a process: ") + std::strerror(errno));
  if (pid == 0) become(arguments, errors.c_str(), limit_of(child.cpu_limit), parent);

  int status = 0;
  rusage usage{};
  // Looks often at first, as many children are short.
  for (std::chrono::microseconds pause{500}; wait4(pid, &status, WNOHANG, &usage) == 0;
       pause = std::min<std::chrono::microseconds>(2 * pause, std::chrono::milliseconds(50))) {
    if (watch.noted() != 0) kill(pid, SIGTERM);
    std::this_thread::sleep_for(pause);
  }
  if (watch.noted() != 0) throw Interrupted("stopped by a signal", watch.noted());
  ChildEnd end;
  end.user_s = seconds(usage.ru_utime);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

}  // namespace tamp::tools
