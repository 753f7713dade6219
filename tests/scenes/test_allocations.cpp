#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "runtime/execute/on_workers.hpp"
#include "tasks/simulation.hpp"
#include "tests/scenes/count_allocations.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_allocations
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Allocations and page faults of steps that write nothing, after the first ten, where no patch outgrew its storage.
struct Requests {
  std::vector<long> allocations;
  std::vector<long> page_faults;
};

long n_page_faults()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// On a busy machine a thread may first come along when many steps have been run, and asks for memory of its own then.
void wait_for_threads(runtime::Executor& executor)
{
  std::atomic<int> n_there{0};
  const auto too_late = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  runtime::on_workers(executor, executor.n_threads(), [&](int) {
    ++n_there;
    while (n_there < executor.n_threads() && std::chrono::steady_clock::now() < too_late) std::this_thread::yield();
  });
}

Requests requests_of(const std::string& scene, const std::vector<std::string>& assignments, int n_threads,
                     int n_steps = 120)
{
  const auto simulation =
      tasks::Simulation::make(tools::read_scene(TAMP_SOURCE_DIR "/inputs/" + scene, assignments).scene, n_threads);
  const runtime::LedgerEntry& memory = simulation->engine().warehouse().ledger().total();
  Requests requests;
  wait_for_threads(simulation->engine().executor());
  for (int i = 0; i < n_steps; ++i) {
    const std::size_t bytes = memory.current();
    const long allocations = n_allocations(), page_faults = n_page_faults();
    simulation->advance(simulation->scene().time.end);
    const long made = n_allocations() - allocations, faulted = n_page_faults() - page_faults;
    if (i < 10 || memory.current() != bytes) continue;
    requests.allocations.push_back(made);
    requests.page_faults.push_back(faulted);
  }
  return requests;
}

void check_that_steps_ask_for_nothing(const std::string& scene, const std::vector<std::string>& assignments = {},
                                      int n_threads = 1)
{
  CAPTURE(scene, assignments, n_threads);
  Requests requests = requests_of(scene, assignments, n_threads);
  REQUIRE(requests.allocations.size() > 50);
  CHECK(std::ranges::max(requests.allocations) == 0);
  std::ranges::nth_element(requests.page_faults, requests.page_faults.begin() + 50);
  CHECK(requests.page_faults[50] == 0);
}

}  // namespace

TEST_CASE("allocations of this program, of the standard library and of others are counted")
{
  if (!counts_allocations) return;
  const long before = n_allocations();

  const auto number = std::make_unique<std::vector<double>>(100);
  const Eigen::VectorXd vector = Eigen::VectorXd::Zero(100);

  CHECK(number->size() + static_cast<std::size_t>(vector.size()) == 200);
  CHECK(n_allocations() - before >= 3);
}

TEST_CASE("steps that write nothing ask for no memory once the first have passed", "[slow]")
{
  if (!counts_allocations) return;
  const std::string punch = "punch/quick.json";
  SECTION("on one thread and on two")
  {
    check_that_steps_ask_for_nothing(punch);
    check_that_steps_ask_for_nothing(punch, {}, 2);
  }
  SECTION("shipped scenes")
  {
    for (const std::string scene :
         {"uxo/quick.json", "footing/quick.json", "footing/circular.json", "cone/quick.json", "savings/rod.json"}) {
      check_that_steps_ask_for_nothing(scene);
    }
  }
  SECTION("moduli")
  {
    for (const std::string name : {"svr", "mlp"}) {
      check_that_steps_ask_for_nothing(punch, {"/materials/sand/modulus/type=" + name});
    }
  }
  SECTION("interpolators")
  {
    check_that_steps_ask_for_nothing("peers/block.json", {"/interpolator=linear", "/time/rule=published"});
    for (const std::string name : {"gimp", "cpgimp", "cpdi", "quadratic_spline", "cubic_spline"}) {
      check_that_steps_ask_for_nothing(punch, {"/interpolator=" + name});
    }
  }
  SECTION("transfers")
  {
    for (const std::string name : {"pic", "flip", "blend", "tflip", "tpic", "apic", "xpic", "fmpm"}) {
      check_that_steps_ask_for_nothing(punch, {"/transfer=" + name});
    }
  }
  SECTION("orders of a step, locking and contact")
  {
    check_that_steps_ask_for_nothing(punch, {"/stress_timing=usf"});
    check_that_steps_ask_for_nothing(punch, {"/stress_timing=musl"});
    check_that_steps_ask_for_nothing(punch, {"/anti_locking=f_bar"});
    check_that_steps_ask_for_nothing(punch, {"/anti_locking=cell_average"});
    check_that_steps_ask_for_nothing(punch, {"/contact/0/normal=flatter"});
  }
}

}  // namespace test_allocations
