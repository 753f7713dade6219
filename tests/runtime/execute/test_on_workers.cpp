#include "runtime/execute/on_workers.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/runtime/shared_cores.hpp"

namespace test_on_workers
{

using namespace tamp::runtime;

TEST_CASE("workers make every call once, however many they are")
{
  const int n_threads = GENERATE(1, 3), n = GENERATE(0, 1, 2, 50);
  Executor executor(n_threads, tamp::test::on_shared_cores());
  std::vector<int> calls(static_cast<std::size_t>(n), 0);

  for (int round = 0; round < 3; ++round) on_workers(executor, n, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });

  CHECK(calls == std::vector<int>(static_cast<std::size_t>(n), 3));
}

TEST_CASE("what a worker's call throws is thrown as it is, and the workers go on with other calls")
{
  Executor executor(2, tamp::test::on_shared_cores());
  int n_calls = 0;

  CHECK_THROWS_AS(on_workers(executor, 3,
                             [](int i) {
                               if (i == 1) throw std::out_of_range("no");
                             }),
                  std::out_of_range);
  on_workers(executor, 1, [&](int) { ++n_calls; });

  CHECK(n_calls == 1);
}

}  // namespace test_on_workers
