#include <sys/wait.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <mutex>
#include <thread>

#include "runtime/execute/executor.hpp"
#include "tests/runtime/execute/toy_work.hpp"

namespace tamp::runtime::test_stall
{

namespace
{

using Catch::Contains;

/// Keeps the reports, and does something when a run has stalled.
struct Listener {
  ExecutorOptions options(double limit, std::function<void()> give_up)
  {
    ExecutorOptions o;
    o.stall.limit = limit;
    o.stall.prefix = "rank 1: ";
    o.stall.print = [this](const std::string& report) {
      const std::lock_guard lock(mutex);
      text += report;
      ++n_reports;
    };
    o.stall.give_up = std::move(give_up);
    return o;
  }
  std::mutex mutex;
  std::string text;
  std::atomic<int> n_reports{0};
};

void sleep(double seconds)
{
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace

TEST_CASE("a message that does not come is named, with the task that waits for it", "[executor][stall]")
{
  const int n_threads = GENERATE(1, 2);
  test::ToyWork work;
  const int message = work.add_remote();
  const int done = work.add({}, [](const Step&) {});
  const int waiting = work.add({done, message}, [](const Step&) {});
  work.add({waiting}, [](const Step&) {});
  Listener listener;
  Executor executor(n_threads, listener.options(0.3, [&] { work.deliver(message); }));
  Schedule schedule(work, n_threads);

  executor.run(schedule, {});

  CHECK_THAT(listener.text, Contains("rank 1: nothing has completed for 0."));
  CHECK_THAT(listener.text, Contains("1 of 3 instances are done, 0 ready\n"));
  // Tasks that wait for another rank come before those that wait for this one.
  CHECK_THAT(listener.text, Contains("rank 1: blocked: task 2 waits for message 0\n"
                                     "rank 1: blocked: task 3 waits for task 2\n"));
  CHECK(listener.n_reports == 1);
}

TEST_CASE("a task that hangs is named, with its worker and for how long", "[executor][stall]")
{
  test::ToyWork work;
  std::atomic<bool> hangs{true};
  const int hanging = work.add({}, [&](const Step&) {
    while (hangs) sleep(0.001);
  });
  work.add({hanging}, [](const Step&) {});
  work.add({}, [](const Step&) {});
  Listener listener;
  Executor executor(1, listener.options(0.3, [&] { hangs = false; }));
  Schedule schedule(work, 1);

  executor.run(schedule, {});

  CHECK_THAT(listener.text, Contains("0 of 3 instances are done, 1 ready\n"));
  CHECK_THAT(listener.text, Contains("rank 1: running for 0."));
  CHECK_THAT(listener.text, Contains(" s on worker 0: task 0\n"));
  CHECK_THAT(listener.text, Contains("blocked: task 1 waits for task 0\n"));
}

TEST_CASE("a run that goes on slowly has not stalled", "[executor][stall]")
{
  test::ToyWork work;
  for (int k = 0; k < 8; ++k) work.add({}, [](const Step&) { sleep(0.1); });
  Listener listener;
  Executor executor(1, listener.options(0.4, [] {}));
  Schedule schedule(work, 1);

  executor.run(schedule, {});
  sleep(0.5);
  executor.run(schedule, {});

  CHECK(listener.n_reports == 0);
}

TEST_CASE("of many blocked tasks and predecessors the first are named and the rest counted", "[executor][stall]")
{
  test::ToyWork work;
  std::vector<int> messages(10);
  for (int& message : messages) message = work.add_remote();
  for (int k = 0; k < 30; ++k) work.add(messages, [](const Step&) {});
  Listener listener;
  Executor executor(1, listener.options(0.2, [&] {
    for (const int m : messages) work.deliver(m);
  }));
  Schedule schedule(work, 1);

  executor.run(schedule, {});

  CHECK_THAT(listener.text, Contains("task 10 waits for message 0, message 1, message 2, message 3, and 6 more\n"));
  CHECK_THAT(listener.text, Contains("blocked: 10 more\n"));
}

TEST_CASE("a report on request says what runs and ends nothing", "[executor][stall]")
{
  test::ToyWork work;
  Listener listener;
  Executor executor(1, listener.options(std::numeric_limits<double>::infinity(), [] { FAIL("given up"); }));
  work.add({}, [&](const Step&) {
    executor.request_report();
    while (listener.n_reports == 0) sleep(0.001);
  });
  Schedule schedule(work, 1);

  executor.run(schedule, {});
  CHECK_THAT(listener.text, Contains("on worker 0: task 0\n"));

  executor.request_report();
  while (listener.n_reports == 1) sleep(0.001);
  CHECK_THAT(listener.text, Contains("rank 1: no step is being run\n"));
}

// Run by the next test in a process of its own.
TEST_CASE("stall for good", "[.stall-for-good]")
{
  test::ToyWork work;
  work.add({work.add_remote()}, [](const Step&) {});
  ExecutorOptions options;
  options.stall.limit = 0.3;
  Executor executor(1, options);
  Schedule schedule(work, 1);

  executor.run(schedule, {});
}

TEST_CASE("a stalled process reports on the standard error stream and ends with exit code 3", "[executor][stall]")
{
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  FILE* child = popen(("'" + program + "' '[.stall-for-good]' 2>&1 >/dev/null").c_str(), "r");
  REQUIRE(child != nullptr);
  std::string text;
  std::array<char, 512> piece{};
  while (std::fgets(piece.data(), piece.size(), child) != nullptr) text += piece.data();
  const int status = pclose(child);

  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 3);
  CHECK_THAT(text, Contains("blocked: task 1 waits for message 0\n"));
}

}  // namespace tamp::runtime::test_stall
