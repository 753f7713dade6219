#include "runtime/execute/watchdog.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace tamp::runtime
{

void print_report(const std::string& report)
{
  std::fputs(report.c_str(), stderr);
  std::fflush(stderr);
}

void end_stalled_process()
{
  std::this_thread::sleep_for(std::chrono::seconds(2));
  std::_Exit(3);
}

Watchdog::Watchdog(StallOptions options, std::function<std::uint64_t()> progress,
                   std::function<std::string(double)> report)
    : options_(std::move(options)),
      progress_(std::move(progress)),
      report_(std::move(report)),
      thread_([this] { look_on(); })
{
}

Watchdog::~Watchdog()
{
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  leaving_.notify_one();
  thread_.join();
}

void Watchdog::set_watching(bool watching, const char* activity)
{
  const std::lock_guard lock(mutex_);
  activity_ = activity;
  watching_ = watching;
  begun_ = watching;
}

void Watchdog::look_on()
{
  std::unique_lock lock(mutex_);
  while (!leaving_.wait_for(lock, std::chrono::milliseconds(100), [this] { return leave_; })) {
    if (watching_) {
      look();
    } else if (requested_.exchange(false)) {
      print("no step is being run\n");
    }
  }
}

void Watchdog::look()
{
  const Clock::time_point now = Clock::now();
  const std::uint64_t progress = activity_ == nullptr ? progress_() : 0;
  if (begun_ || progress != last_progress_) {
    begun_ = false;
    reported_ = false;
    last_progress_ = progress;
    last_change_ = now;
  }
  const double idle_time = std::chrono::duration<double>(now - last_change_).count();
  const bool stalled = idle_time > options_.limit && !reported_;
  if (requested_.exchange(false) || stalled) {
    print(activity_ == nullptr ? report_(idle_time) : fmt::format("{} for {:.1f} s\n", activity_, idle_time));
  }
  if (stalled) {
    reported_ = true;
    options_.give_up();
  }
}

void Watchdog::print(const std::string& report) const
{
  std::string text;
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) text += options_.prefix + line + '\n';
  options_.print(text);
}

}  // namespace tamp::runtime
