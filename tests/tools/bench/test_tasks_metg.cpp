#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tools/bench/tasks_metg.hpp"

namespace test_tasks_metg
{

using namespace tamp::tools::bench;

TEST_CASE("METG is interpolated in the logarithm of the granularity")
{
  const std::vector<TaskSample> samples{{50, 5}, {100, 25}, {400, 300}, {1600, 1500}};

  CHECK(metg50(samples).value() == Approx(200));
}

TEST_CASE("METG of tasks with a fixed overhead is twice the overhead")
{
  const double first = GENERATE(20., 23., 27., 31., 36.);
  const double overhead = 100;
  std::vector<TaskSample> samples;
  for (double kernel = first; kernel < 1000; kernel *= 2) samples.push_back({kernel + overhead, kernel});

  CHECK(metg50(samples).value() == Approx(2 * overhead).epsilon(0.03));
}

TEST_CASE("there is no METG where the efficiency does not rise through one half")
{
  CHECK_FALSE(metg50(std::vector<TaskSample>{}));
  CHECK_FALSE(metg50(std::vector<TaskSample>{{100, 10}, {200, 99}}));
  CHECK_FALSE(metg50(std::vector<TaskSample>{{100, 60}, {200, 150}}));
}

}  // namespace test_tasks_metg
