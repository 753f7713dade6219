#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <thread>

#include "runtime/execute/executor.hpp"
#include "tests/runtime/execute/toy_work.hpp"

namespace tamp::runtime::test_messages
{

namespace
{

/// One, two, three threads, and one that shuffles.
std::unique_ptr<Executor> any_executor()
{
  const int n_threads = GENERATE(0, 1, 2, 3);
  return n_threads == 0 ? Executor::shuffled(7) : std::make_unique<Executor>(n_threads);
}

}  // namespace

TEST_CASE("an instance waits for the message of another rank's, and others run meanwhile", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  std::atomic<int> n_free{0}, n_free_before{-1};
  const int message = work.add_remote();
  work.add({message}, [&](const Step&) { n_free_before = n_free.load(); });
  for (int k = 0; k < 10; ++k) {
    work.add({}, [&](const Step&) {
      if (++n_free == 10) work.deliver(message);
    });
  }
  Schedule schedule(work, executor->n_threads());

  executor->run(schedule, {});

  CHECK(n_free_before == 10);
}

TEST_CASE("messages from another thread, late by turns, release what waits for them step after step",
          "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  std::atomic<long> sent{0};
  std::vector<int> messages(4);
  for (int& message : messages) message = work.add_remote();
  std::atomic<int> n_run{0}, n_early{0};
  for (int k = 0; k < 4; ++k) {
    const int own = work.add(k, {}, [&](const Step&) { ++n_run; });
    work.add(k + 1, {messages[static_cast<std::size_t>(k)], own}, [&, k](const Step& step) {
      n_early += sent < 4 * (step.index - 1) + k + 1;
      ++n_run;
    });
  }
  Schedule schedule(work, executor->n_threads());
  std::atomic<long> begun{0};
  std::thread other_rank([&] {
    for (long step = 1; step <= 50; ++step) {
      while (begun < step) std::this_thread::yield();
      for (const int message : messages) {
        if (step % 3 == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
        ++sent;
        work.deliver(message);
      }
    }
  });

  for (long step = 1; step <= 50; ++step) {
    begun = step;
    executor->run(schedule, {step, 0, 1, 1});
  }
  other_rank.join();

  CHECK(n_run == 50 * 8);
  CHECK(n_early == 0);
}

TEST_CASE("a message of the next step may come while this one runs", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  const int message = work.add_remote();
  int n_run = 0;
  const int consumer = work.add({message}, [&](const Step&) {
    ++n_run;
    work.deliver(message);
  });
  // Long enough for workers to poll before this step is over.
  work.add({consumer}, [](const Step&) { std::this_thread::sleep_for(std::chrono::microseconds(100)); });
  Schedule schedule(work, executor->n_threads());
  work.deliver(message);

  for (long step = 1; step <= 20; ++step) executor->run(schedule, {step, 0, 1, 1});

  CHECK(n_run == 20);
}

TEST_CASE("the record of another rank's instance says when its message came", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  const int message = work.add_remote();
  const int before = work.add({}, [&](const Step&) { work.deliver(message); });
  const int after = work.add({message}, [](const Step&) {});
  Schedule schedule(work, executor->n_threads());

  executor->run(schedule, {});

  const auto& records = schedule.records();
  CHECK(records[0].start == records[0].end);
  CHECK(records[0].end >= records[static_cast<std::size_t>(before)].start);
  CHECK(records[0].end <= records[static_cast<std::size_t>(after)].start);
}

TEST_CASE("of graphs over several ranks one runs at a time", "[executor][messages]")
{
  test::ToyWork inner, outer;
  inner.add(0, {}, [](const Step&) {});
  Schedule inside(inner, 1);
  Executor one(1), other(1);
  outer.add(0, {}, [&](const Step& step) { other.run(inside, step); });
  Schedule outside(outer, 1);

  CHECK_THROWS_WITH(one.run(outside, {}), Catch::Contains("two graphs over several ranks run at once"));
  CHECK_NOTHROW(other.run(inside, {}));
}

TEST_CASE("the failure of another rank stops the run and comes out as it is", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  const int message = work.add_remote();
  std::atomic<bool> was_run{false};
  work.add({message}, [&](const Step&) { was_run = true; });
  work.on_poll = [&] {
    if (work.n_polls > 5) throw std::out_of_range("rank 3 has gone");
  };
  Schedule schedule(work, executor->n_threads());

  CHECK_THROWS_AS(executor->run(schedule, {}), std::out_of_range);

  CHECK_FALSE(was_run);
  CHECK(work.failures.empty());
}

TEST_CASE("other ranks learn once of a task that fails", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  for (int k = 0; k < 6; ++k) {
    work.add(k, {}, [](const Step&) { throw std::runtime_error("no luck"); });
  }
  Schedule schedule(work, executor->n_threads());

  std::string what;
  try {
    executor->run(schedule, {});
  } catch (const TaskError& error) {
    what = error.what();
  }

  REQUIRE(work.failures.size() == 1);
  CHECK(work.failures.front() == what);
  CHECK_THAT(what, Catch::EndsWith(": no luck"));
}

TEST_CASE("with a window of one, one thread keeps to program order and waits for messages", "[executor][messages]")
{
  ExecutorOptions options;
  options.window = GENERATE(std::size_t{1}, std::size_t{64});
  Executor executor(1, options);
  test::ToyWork work;
  std::vector<int> order;
  const int message = work.add_remote();
  work.add({}, [&](const Step&) { order.push_back(1); });
  work.add({message}, [&](const Step&) { order.push_back(2); });
  work.add({}, [&](const Step&) { order.push_back(3); });
  Schedule schedule(work, 1);
  std::thread other_rank([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    work.deliver(message);
  });

  executor.run(schedule, {});
  other_rank.join();

  CHECK(order == (options.window == 1 ? std::vector<int>{1, 2, 3} : std::vector<int>{1, 3, 2}));
}

TEST_CASE("busy workers poll between tasks, idle ones all the time, and nobody when there are no messages",
          "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  for (int k = 0; k < 20; ++k) {
    work.add({}, [](const Step&) { std::this_thread::sleep_for(std::chrono::microseconds(100)); });
  }
  Schedule schedule(work, executor->n_threads());

  executor->run(schedule, {});
  CHECK(work.n_polls > 2);

  const int n_polls = work.n_polls;
  work.messages = false;
  executor->run(schedule, {});
  CHECK(work.n_polls == n_polls);
}

TEST_CASE("a worker that has run out of work says so when it polls", "[executor][messages]")
{
  const auto executor = any_executor();
  test::ToyWork work;
  const int message = work.add_remote();
  work.add({message}, [](const Step&) {});
  Schedule schedule(work, executor->n_threads());
  std::thread other_rank([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    work.deliver(message);
  });

  executor->run(schedule, {});
  other_rank.join();

  CHECK(work.n_idle_polls > 10);
  CHECK(work.n_idle_polls >= work.n_polls - 2);
}

TEST_CASE("workers that share their cores get everything done, too", "[executor][messages]")
{
  ExecutorOptions options;
  options.oversubscribed = true;
  Executor executor(4, options);
  test::ToyWork work;
  const int message = work.add_remote();
  int n_run = 0;
  int last = work.add({message}, [&](const Step&) { ++n_run; });
  for (int k = 1; k < 20; ++k) last = work.add(k, {last}, [&](const Step&) { ++n_run; });
  Schedule schedule(work, 4);

  for (long step = 1; step <= 20; ++step) {
    std::thread other_rank([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
      work.deliver(message);
    });
    executor.run(schedule, {step, 0, 1, 1});
    other_rank.join();
  }

  CHECK(n_run == 20 * 20);
}

}  // namespace tamp::runtime::test_messages
