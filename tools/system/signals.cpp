#include "tools/system/signals.hpp"

#include <atomic>
#include <csignal>

namespace tamp::tools
{

namespace
{

std::atomic<int> noted_signal{0};
std::atomic<runtime::Executor*> watched{nullptr};

void note(int signal)
{
  noted_signal = signal == SIGUSR2 ? SIGTERM : signal;
}

void ask_for_report(int)
{
  if (runtime::Executor* executor = watched; executor != nullptr) executor->request_report();
}

}  // namespace

void note_early_signals()
{
  std::signal(SIGUSR1, SIG_IGN);
  std::signal(SIGUSR2, note);
}

SignalWatch::SignalWatch(runtime::Executor* executor)
{
  watched = executor;
  for (const int signal : {SIGTERM, SIGINT, SIGXCPU, SIGUSR2}) std::signal(signal, note);
  if (std::signal(SIGHUP, note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGUSR1, ask_for_report);
}

SignalWatch::~SignalWatch()
{
  for (const int signal : {SIGTERM, SIGINT, SIGXCPU}) std::signal(signal, SIG_DFL);
  if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  // A request that comes too late is ignored: by default these signals would end the program.
  for (const int signal : {SIGUSR1, SIGUSR2}) std::signal(signal, SIG_IGN);
  watched = nullptr;
}

int SignalWatch::received() const
{
  return noted_signal;
}

}  // namespace tamp::tools
