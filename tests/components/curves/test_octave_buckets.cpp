#include "components/curves/octave_buckets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace test_octave_buckets
{

using tamp::components::OctaveBuckets;

TEST_CASE(
    "buckets follow on each other, and a number's place in its bucket is that of a straight line between the ends")
{
  const int octaves = GENERATE(0, 1, 7, 30);
  const OctaveBuckets buckets(-3, 5, std::ldexp(8, -octaves), 3);

  CHECK(buckets.of(-3) == 0);
  CHECK(buckets.of(5) + 1 == buckets.size());
  for (std::size_t b = 0; b + 1 < buckets.size(); ++b) {
    const double start = buckets.start(b), end = buckets.start(b + 1);
    for (const double part : {0.01, 0.5, 0.99}) {
      const double x = start + part * (end - start);
      REQUIRE(buckets.of(x) == b);
      // x itself is only known to its round-off, which narrow buckets feel.
      REQUIRE(buckets.place(x) == Approx(part).epsilon(1e-12).margin(4e-15 / (end - start)));
    }
  }
}

TEST_CASE("numbers outside the range have the first or the last bucket, and what is no number the first")
{
  const OctaveBuckets buckets(-3, 5, 0.5, 2);
  CHECK(buckets.of(-1e300) == 0);
  CHECK(buckets.of(1e300) + 1 == buckets.size());
  CHECK(buckets.of(std::numeric_limits<double>::infinity()) + 1 == buckets.size());
  CHECK(buckets.of(std::numeric_limits<double>::quiet_NaN()) == 0);
}

}  // namespace test_octave_buckets
