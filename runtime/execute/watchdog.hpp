#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tamp::runtime
{

/// Prints on the standard error stream, in one piece.
void print_report(const std::string& report);
/// Leaves the other ranks the time to print their reports, then ends the process with exit code 3.
void end_stalled_process();

/// When a run has stalled, and what is done then.
struct StallOptions {
  /// How long nothing completes [s]; infinity: never.
  double limit = 300;
  /// The start of each line of a report: "rank 1: ".
  std::string prefix;
  std::function<void(const std::string& report)> print = print_report;
  /// Called after the report of a stall, which is made once.
  std::function<void()> give_up = end_stalled_process;
};

/// Looks at the progress of a run ten times a second, from a thread of its own, and reports when there is none for
/// long, or on request. Whoever makes the progress takes no notice of it.
class Watchdog
{
 public:
  /// Both are called between the beginning and the end of a watch only: a number that changes with any progress,
  /// and the state in words, given for how long nothing has happened [s].
  Watchdog(StallOptions options, std::function<std::uint64_t()> progress, std::function<std::string(double)> report);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// While one of these lives there is something to look at: a run that makes progress, or an activity, described as in
  /// "writing fields", that must end in time. One at a time.
  class Watch
  {
   public:
    explicit Watch(Watchdog& dog, const char* activity = nullptr) : dog_(dog) { dog_.set_watching(true, activity); }
    ~Watch() { dog_.set_watching(false, nullptr); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    Watchdog& dog_;
  };

  void request_report() noexcept { requested_ = true; }

 private:
  using Clock = std::chrono::steady_clock;

  void set_watching(bool watching, const char* activity);
  void look_on();
  void look();
  void print(const std::string& report) const;

  StallOptions options_;
  std::function<std::uint64_t()> progress_;
  std::function<std::string(double)> report_;
  std::atomic<bool> requested_{false};

  /// Guards what follows; held while the watchdog looks.
  std::mutex mutex_;
  std::condition_variable leaving_;
  bool leave_ = false;
  bool watching_ = false;
  /// Null while a run is watched.
  const char* activity_ = nullptr;
  bool begun_ = false;
  bool reported_ = false;
  std::uint64_t last_progress_ = 0;
  Clock::time_point last_change_;

  std::thread thread_;
};

}  // namespace tamp::runtime
