#include "components/portable_math.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/same_bits.hpp"

namespace test_portable_math
{

namespace portable = tamp::portable;
using tamp::Lanes;
using tamp::test::same_bits;

namespace
{

struct Function {
  std::string name;
  std::function<double(double)> portable;
  std::function<long double(long double)> exact;
  double first, last;
};

const std::vector<Function>& functions()
{
  using L = long double;
  static const std::vector<Function> all{
      {"exp", [](double x) { return portable::exp(x); }, [](L x) { return std::exp(x); }, -700, 700},
      {"expm1", [](double x) { return portable::expm1(x); }, [](L x) { return std::expm1(x); }, -30, 700},
      {"log", [](double x) { return portable::log(x); }, [](L x) { return std::log(x); }, 1e-300, 1e6},
      {"log1p", [](double x) { return portable::log1p(x); }, [](L x) { return std::log1p(x); }, -0.99, 100},
      {"log2", portable::log2, [](L x) { return std::log2(x); }, 1e-3, 1e6},
      {"x^(-5/3)", [](double x) { return portable::pow(x, -5.0 / 3); }, [](L x) { return std::pow(x, L{-5.0 / 3}); },
       0.01, 100},
      {"hypot(x, 3)", [](double x) { return portable::hypot(x, 3); }, [](L x) { return std::hypot(x, L{3}); }, -10, 10},
      {"sin", portable::sin, [](L x) { return std::sin(x); }, -100, 100},
      {"cos", [](double x) { return portable::cos(x); }, [](L x) { return std::cos(x); }, -100, 100},
      {"asin", portable::asin, [](L x) { return std::asin(x); }, -1, 1},
      {"acos", [](double x) { return portable::acos(x); }, [](L x) { return std::acos(x); }, -1, 1},
      {"atan2(x, -2)", [](double x) { return portable::atan2(x, -2); }, [](L x) { return std::atan2(x, L{-2}); }, -9,
       9},
      {"tanh", [](double x) { return portable::tanh(x); }, [](L x) { return std::tanh(x); }, -20, 20}};
  return all;
}

/// Evenly spaced, with odd bits.
std::vector<double> arguments(const Function& f)
{
  constexpr int n = 10'000;
  std::vector<double> all;
  for (int i = 1; i < n; ++i) all.push_back(f.first + (f.last - f.first) * i / n);
  return all;
}

/// Undefined symbols of a library by the `nm` of the build, a line each: OBJECT: U NAME.
std::vector<std::string> undefined_symbols(const std::string& library)
{
  std::vector<std::string> lines;
  FILE* const listing = popen((TAMP_NM " -A -u " + library).c_str(), "r");
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), line.size(), listing) != nullptr) lines.emplace_back(line.data());
  REQUIRE(pclose(listing) == 0);
  return lines;
}

}  // namespace

TEST_CASE("portable functions of lanes have the bits of those of one number")
{
  struct Pair {
    std::string name;
    std::function<Lanes(const Lanes&)> of_lanes;
    std::function<double(double)> of_one;
    double first, last;
  };
  const auto power = [](const auto& x) { return portable::pow(x, std::decay_t<decltype(x)>(-5.0 / 3)); };
  const std::vector<Pair> all{
      {"exp", [](const Lanes& x) { return portable::exp(x); }, [](double x) { return portable::exp(x); }, -800, 800},
      {"expm1", [](const Lanes& x) { return portable::expm1(x); }, [](double x) { return portable::expm1(x); }, -50,
       800},
      {"log", [](const Lanes& x) { return portable::log(x); }, [](double x) { return portable::log(x); }, -1, 100},
      {"log1p", [](const Lanes& x) { return portable::log1p(x); }, [](double x) { return portable::log1p(x); }, -2,
       100},
      {"x^(-5/3)", power, power, -1, 100},
      {"cos", [](const Lanes& x) { return portable::cos(x); }, [](double x) { return portable::cos(x); }, -15, 15},
      {"acos", [](const Lanes& x) { return portable::acos(x); }, [](double x) { return portable::acos(x); }, -1.1, 1.1},
      {"tanh", [](const Lanes& x) { return portable::tanh(x); }, [](double x) { return portable::tanh(x); }, -30, 30}};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 8> extremes{0, -0.0, 1e-310, -1e-310, 1, infinity, -infinity, -1};

  std::mt19937_64 random(1);
  for (const Pair& f : all) {
    INFO(f.name);
    std::uniform_real_distribution<double> argument(f.first, f.last);
    bool same = true;
    for (int i = 0; i < 100'000; ++i) {
      const Lanes x([&](auto) { return random() % 50 == 0 ? extremes[random() % 8] : argument(random); });
      const Lanes found = f.of_lanes(x);
      for (std::size_t l = 0; l < tamp::n_lanes; ++l) same = same && same_bits(found[l], f.of_one(x[l]));
    }
    CHECK(same);
  }
}

TEST_CASE("portable functions are within a unit in the last place of the exact value")
{
  for (const Function& f : functions()) {
    INFO(f.name);
    double worst = 0;
    for (const double x : arguments(f)) {
      const long double exact = f.exact(x);
      const double unit = std::abs(std::nextafter(static_cast<double>(exact), 0.0) - static_cast<double>(exact));
      worst = std::max(worst, static_cast<double>(std::abs(f.portable(x) - exact)) / unit);
    }
    CHECK(worst < 2.0);  // a unit seen from below a power of two is half of one
  }
}

// The bits are those of SLEEF 3.5.1. A change means that results differ from those of other machines.
TEST_CASE("portable functions have the bits that they have everywhere")
{
  std::uint64_t hash = 14695981039346656037U;
  for (const Function& f : functions()) {
    for (const double x : arguments(f)) hash = (hash ^ std::bit_cast<std::uint64_t>(f.portable(x))) * 1099511628211U;
  }

  CHECK(hash == 0x49cfb0cd7c1b3072U);
}

TEST_CASE("the exponential of 64 bits is within 2 units in the last place, with the bits that it has everywhere")
{
  double worst = 0;
  std::uint64_t hash = 14695981039346656037U;
  for (int i = 0; i < 100'000; ++i) {
    const long double x = -400 + 800 * (static_cast<long double>(i) + 0.3L) / 100'000, found = portable::exp(x);
    int exponent = 0;
    const auto bits = static_cast<std::uint64_t>(std::ldexp(std::frexp(found, &exponent), 64));
    worst = std::max(worst, static_cast<double>(std::abs(found - std::exp(x)) / std::ldexp(1.0L, exponent - 64)));
    hash = (hash ^ bits) * 1099511628211U;
  }

  CHECK(portable::exp(0.0L) == 1);
  CHECK(worst > 0);  // it isn't the C library's
  CHECK(worst < 3);  // the C library's own error is within 1
  CHECK(hash == 0x63fc7fe2032149c6U);
}

TEST_CASE("nothing that decides a result calls the C library's elementary functions")
{
  int n_symbols = 0;
  for (const std::string library : {TAMP_COMPONENTS, TAMP_TASKS}) {
    for (const std::string& line : undefined_symbols(library)) {
      if (line.find("closed_mesh") != std::string::npos) continue;  // CGAL's filters, whose answers are exact
      ++n_symbols;
      INFO(line);
      for (const std::string name :
           {"exp", "exp2",   "exp10", "expm1", "log",  "log2", "log10", "log1p", "pow",  "cbrt", "hypot", "sin",
            "cos", "sincos", "tan",   "asin",  "acos", "atan", "atan2", "sinh",  "cosh", "tanh", "fma"}) {
        CHECK(line.find(" U " + name + "\n") == std::string::npos);
        CHECK(line.find(" U " + name + "l\n") == std::string::npos);
      }
    }
  }
  CHECK(n_symbols > 100);
}

}  // namespace test_portable_math
