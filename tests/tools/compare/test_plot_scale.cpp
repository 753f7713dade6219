#include <catch2/catch.hpp>
#include <cmath>

#include "tools/compare/plot_scale.hpp"

using namespace tamp::tools::compare;

TEST_CASE("a prefix brings a number between one and a thousand")
{
  CHECK(si_text(0.000312, "s") == "312 µs");
  CHECK(si_text(2.5e9, "Pa") == "2.5 GPa");
  CHECK(si_text(0, "m") == "0 m");
  CHECK(si_text(-0.2, "m") == "-200 mm");
}

TEST_CASE("a number that three digits round to a thousand takes the next prefix")
{
  CHECK(si_text(999.4e-6, "s") == "999 µs");
  CHECK(si_text(999.7e-6, "s") == "1 ms");
}

TEST_CASE("numbers beyond all prefixes keep the last one")
{
  CHECK(si_text(3e-15, "s") == "0.003 ps");
  CHECK(si_text(3e16, "Pa") == "3e+04 TPa");
}

TEST_CASE("linear ticks are round numbers that enclose the range")
{
  CHECK(linear_ticks(0, 7e-3, 6) == std::vector<double>{0, 2e-3, 4e-3, 6e-3, 8e-3});
  CHECK(linear_ticks(-3, 11, 5) == std::vector<double>{-5, 0, 5, 10, 15});
}

TEST_CASE("a range whose bounds are ticks gets none beyond them")
{
  const std::vector<double> ticks = linear_ticks(0, 0.3, 3);

  REQUIRE(ticks.size() == 4);
  CHECK(ticks.back() == Approx(0.3));
}

TEST_CASE("ticks of a range without width enclose its value")
{
  for (const double value : {0.0, 5.0, -5.0}) {
    const std::vector<double> ticks = linear_ticks(value, value, 5);
    INFO(value);
    CHECK(ticks.size() >= 2);
    CHECK(ticks.front() <= value);
    CHECK(ticks.back() > value);
  }
}

TEST_CASE("logarithmic ticks are 1, 2 and 5 and enclose the range")
{
  const std::vector<double> ticks = log_ticks(3e-4, 4e-3);

  REQUIRE(ticks.size() == 5);
  CHECK(ticks.front() == Approx(2e-4));
  CHECK(ticks[1] == Approx(5e-4));
  CHECK(ticks[2] == Approx(1e-3));
  CHECK(ticks[3] == Approx(2e-3));
  CHECK(ticks.back() == Approx(5e-3));
}

TEST_CASE("logarithmic ticks over many decades are powers of ten")
{
  const std::vector<double> ticks = log_ticks(2, 5e4);

  REQUIRE(ticks.size() == 6);
  CHECK(ticks.front() == Approx(1));
  CHECK(ticks.back() == Approx(1e5));
}

TEST_CASE("logarithmic ticks of a single value enclose it")
{
  for (const double value : {1.0, 3e-4, 0.5}) {
    const std::vector<double> ticks = log_ticks(value, value);
    INFO(value);
    REQUIRE(ticks.size() >= 2);
    CHECK(ticks.front() <= value * (1 + 1e-9));
    CHECK(ticks.back() >= value * (1 - 1e-9));
  }
}

TEST_CASE("a series that is thinned keeps its ends, its peaks and its order")
{
  std::vector<PlotPoint> points;
  for (int i = 0; i < 10000; ++i) points.push_back({static_cast<double>(i), std::sin(0.01 * i)});
  points[1234].y = 50;
  points[8765].y = -50;

  const std::vector<PlotPoint> few = thinned(points, 400);

  CHECK(few.size() <= 402);
  CHECK(few.front().x == 0);
  CHECK(few.back().x == 9999);
  CHECK(std::is_sorted(few.begin(), few.end(), [](const auto& a, const auto& b) { return a.x < b.x; }));
  for (const double peak : {50.0, -50.0}) {
    CHECK(std::any_of(few.begin(), few.end(), [&](const PlotPoint& point) { return point.y == peak; }));
  }
}

TEST_CASE("a short series is left as it is")
{
  const std::vector<PlotPoint> points{{0, 1}, {1, 5}, {2, 3}};

  CHECK(thinned(points, 400).size() == 3);
  CHECK(thinned({}, 400).empty());
}
