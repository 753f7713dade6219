#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <numeric>

#include "runtime/engine.hpp"
#include "runtime/ranks/gather_by_patch.hpp"

/// Counts beyond 2 and 4 GiB, on two ranks with some 15 GiB of memory. Hidden, as they take a minute:
///
///     mpirun -n 2 build/release/tests/tamp_runtime_tests "[large]"
namespace test_large
{

using namespace tamp::runtime;

namespace
{

constexpr std::size_t gibibyte = std::size_t{1} << 30;

/// Numbers of which no two stretches are alike.
std::vector<std::uint64_t> numbers(std::size_t n_bytes)
{
  std::vector<std::uint64_t> all(n_bytes / sizeof(std::uint64_t));
  std::iota(all.begin(), all.end(), 7);
  return all;
}

bool are_numbers(std::span<const std::uint64_t> all)
{
  std::uint64_t next = 7;
  return std::all_of(all.begin(), all.end(), [&](std::uint64_t found) { return found == next++; });
}

std::size_t resident()
{
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t most_resident()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// A KiB for each particle.
using Load = std::array<double, 128>;
const ParticleLabel<Load, "load"> load;

GraphTasks adding_one()
{
  const TaskDeclaration add = task("add one")
                                  .over_patches_and_groups()
                                  .reads(load.previous())
                                  .computes(load)
                                  .body([](const TaskContext&, auto data) {
                                    const auto old = data[load.previous()];
                                    const auto now = data[load];
                                    for (std::size_t p = 0; p < now.size(); ++p) {
                                      now[p] = old[p];
                                      now[p].back() += 1;
                                    }
                                  });
  return {{add}, {{&load}, {}}};
}

}  // namespace

// The first, as the most that a process has held is that of all cases before.
TEST_CASE("a deal moves more than 2 GiB, in no more memory than the ledger says", "[.large]")
{
  const Communicator world = Communicator::world();
  REQUIRE(world.size() == 2);
  const std::size_t n = (2 * gibibyte + gibibyte / 4) / sizeof(Load);
  const std::size_t at_start = resident();
  PatchLayout layout({2, {0, 0, 0}, 1, {4, 2, 1}}, {2, 1, 1});
  layout.give_to_ranks({0, 0}, 2);
  Executor executor(1);
  Engine engine(layout, {"only"}, {adding_one()}, executor, world);
  if (world.is_first()) {
    engine.warehouse().set_n_particles(1, 0, n);
    const auto loads = engine.warehouse().state(load, 1, 0);
    for (std::size_t p = 0; p < n; ++p) loads[p].fill(static_cast<double>(p));
  }
  engine.advance(1);

  engine.deal({0, 1});
  engine.advance(1);

  const MemoryLedger& ledger = engine.warehouse().ledger();
  if (!world.is_first()) {
    const auto loads = engine.warehouse().state(load, 1, 0);
    REQUIRE(loads.size() == n);
    bool is_right = true;
    for (std::size_t p = 0; p < n; ++p) {
      is_right &= loads[p].front() == static_cast<double>(p) && loads[p].back() == static_cast<double>(p) + 2;
    }
    CHECK(is_right);
    CHECK(static_cast<double>(resident() - at_start) == Approx(ledger.total().current()).epsilon(0.05));
  } else {
    CHECK(ledger.total().current() < gibibyte / 8);
    CHECK(resident() - at_start < gibibyte / 8);
  }
  const auto forecast = static_cast<double>(2 * n * sizeof(Load));
  const auto process = static_cast<double>(most_resident() - at_start);
  WARN("rank " << world.rank() << ": forecast " << forecast << ", ledger " << ledger.total().peak() << ", process "
               << process << " bytes at most");
  CHECK(static_cast<double>(ledger.total().peak()) == Approx(forecast).epsilon(0.05));
  CHECK(process == Approx(forecast).epsilon(0.05));
}

TEST_CASE("more than 4 GiB go from one rank to another", "[.large]")
{
  const Communicator world = Communicator::world();
  REQUIRE(world.size() == 2);
  const std::size_t n = 4 * gibibyte + 4096;
  std::vector<std::uint64_t> all(n / sizeof(std::uint64_t));
  if (world.rank() == 1) {
    all = numbers(n);
    world.send(0, std::as_bytes(std::span(all)));
  } else {
    world.receive(1, std::as_writable_bytes(std::span(all)));
  }

  CHECK(are_numbers(all));
}

TEST_CASE("more than 2 and 4 GiB are gathered", "[.large]")
{
  const Communicator world = Communicator::world();
  REQUIRE(world.size() == 2);
  const std::size_t n = GENERATE(2 * gibibyte + 4096, 4 * gibibyte + 4096);

  SECTION("by patch")
  {
    PatchLayout layout({2, {0, 0, 0}, 1, {2, 1, 1}}, {2, 1, 1});
    layout.give_to_ranks({0, 1}, 2);
    const std::vector<std::uint64_t> n_values{1, n / sizeof(std::uint64_t)};
    std::vector<std::uint64_t> own = world.is_first() ? std::vector<std::uint64_t>{3} : numbers(n);
    const std::vector<std::uint64_t> all = gather_by_patch(std::move(own), n_values, layout, world);
    if (world.is_first()) {
      CHECK(all.front() == 3);
      CHECK(are_numbers(std::span(all).subspan(1)));
    }
  }
  SECTION("by rank")
  {
    const std::vector<std::uint64_t> own = world.is_first() ? std::vector<std::uint64_t>{3} : numbers(n);
    const std::vector<std::vector<std::byte>> all = world.gather(std::as_bytes(std::span(own)));
    REQUIRE(all[1].size() == n);
    CHECK(are_numbers({reinterpret_cast<const std::uint64_t*>(all[1].data()), n / sizeof(std::uint64_t)}));
  }
}

}  // namespace test_large
