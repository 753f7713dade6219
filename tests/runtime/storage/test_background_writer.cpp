#include "runtime/storage/background_writer.hpp"

#include <catch2/catch.hpp>
#include <future>
#include <memory>
#include <stdexcept>

namespace test_background_writer
{

using tamp::runtime::BackgroundWriter;

namespace
{

/// A job that goes on until it is asked to end.
class LongJob
{
 public:
  BackgroundWriter::Job job()
  {
    return [end = end_.get_future().share()] { end.wait(); };
  }
  void end() { end_.set_value(); }

 private:
  std::promise<void> end_;
};

}  // namespace

TEST_CASE("jobs are done one after another in a thread of their own")
{
  BackgroundWriter writer;
  std::vector<std::thread::id> threads;
  std::vector<int> order;

  for (int i = 0; i < 5; ++i) {
    writer.add([&, i] {
      order.push_back(i);
      threads.push_back(std::this_thread::get_id());
    });
  }
  writer.wait();

  CHECK(order == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(threads == std::vector<std::thread::id>(5, threads.front()));
  CHECK(threads.front() != std::this_thread::get_id());
}

TEST_CASE("who waits for the jobs waits for all of them")
{
  LongJob fields, state;
  BackgroundWriter writer;
  writer.add(fields.job());
  writer.add(state.job());

  auto waiting = std::async(std::launch::async, [&] { writer.wait(); });
  fields.end();
  CHECK(waiting.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout);
  state.end();
  waiting.get();

  CHECK(writer.waited() > 0.04);
  CHECK_FALSE(writer.has_failed());
}

TEST_CASE("what a job throws is thrown by the next call, and the jobs after it are dropped")
{
  LongJob first;
  bool done = false;
  BackgroundWriter writer;
  writer.add([&, wait = first.job()] {
    wait();
    throw std::runtime_error("full disk");
  });
  writer.add([&] { done = true; });

  first.end();

  CHECK_THROWS_WITH(writer.wait(), "full disk");
  CHECK(writer.has_failed());
  CHECK_NOTHROW(writer.wait());
  CHECK_FALSE(done);
}

TEST_CASE("the data of a job have gone when it is done")
{
  BackgroundWriter writer;
  auto data = std::make_shared<int>(7);
  const std::weak_ptr<int> watched = data;

  writer.add([data = std::move(data)] { static_cast<void>(*data); });
  writer.wait();

  CHECK(watched.expired());
}

TEST_CASE("jobs that are left when a writer goes are done")
{
  int n_done = 0;
  {
    BackgroundWriter writer;
    for (int i = 0; i < 3; ++i) writer.add([&] { ++n_done; });
  }

  CHECK(n_done == 3);
}

}  // namespace test_background_writer
