#include <catch2/catch.hpp>
#include <deque>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/tools/background_program.hpp"
#include "tests/tools/program.hpp"
#include "tools/bench/peak_rate.hpp"

namespace test_bench_windows
{

using namespace tamp::test;

namespace
{

/// A ball of rubber that falls towards a floor, in forty steps.
const char* falling_ball = R"({
  "dimension": 3,
  "grid": { "upper": [0.8, 0.8, 0.8], "cell_size": 0.1 },
  "time": { "end": 0.02, "maximum_step": 5e-4 },
  "materials": {
    "rubber": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e5, "shear_modulus": 5e4 }
  },
  "bodies": {
    "ball": { "material": "rubber", "velocity": [0, 0, -5],
              "geometry": { "type": "ball", "centre": [0.4, 0.4, 0.4], "radius": 0.2 } }
  }
})";

}  // namespace

TEST_CASE("the benchmark of a scene tells windows from the whole, phases, bounds and bytes, in a table and a file",
          "[slow]")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("ball.json", falling_ball).string();
  const std::string file = (folder.path() / "bench.json").string();

  const Outcome outcome = tamp_with("bench projectile --scene " + scene + " --steps 4 --rounds 1 --json " + file);

  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file)).at("projectile");
  CHECK(json.at("scene") == "ball.json");
  CHECK(json.at("steps") == 40);
  CHECK(json.at("core_share") > 0.0);
  CHECK(json.at("too_busy") == (json.at("core_share") < 0.9));
  REQUIRE(json.at("windows").size() == 3);
  for (const auto& window : json.at("windows")) CHECK(window.at("steps") == 4);
  for (const auto& part : {json, json.at("windows").at(1)}) {
    double sum = part.at("ns_between_tasks");
    for (const auto& phase : part.at("phases")) sum += phase.at("ns_per_particle_step").get<double>();
    CHECK(sum == Approx(part.at("ns_per_particle_step").get<double>()));
    CHECK(part.at("ns_between_tasks") > 0.0);
    CHECK(part.at("bound_ns").get<double>() ==
          Approx(part.at("min_bytes_per_particle_step").get<double>() / json.at("triad_gb_per_s").get<double>()));
    CHECK(part.at("arithmetic_bound_ns").get<double>() ==
          Approx(part.at("min_operations_per_particle_step").get<double>() /
                 json.at("multiply_add_gop_per_s").get<double>()));
    CHECK(part.at("ratio_to_arithmetic_bound") > 1.0);
  }
  // id, body, reference position, mass, laps or not, position, velocity, deformation gradient, volume, stress and so
  // on: all are numbers of eight bytes but the laps.
  const auto& bytes = json.at("bytes").at("of_particles").at(0);
  CHECK(bytes.at("state") >= 8 * (1 + 1 + 3 + 1 + 3 + 3 + 9 + 1 + 6));
  CHECK(bytes.at("kept_state") > bytes.at("state"));
  CHECK(bytes.at("all") > bytes.at("kept_state"));
  CHECK(json.at("bytes").at("with_grid") > bytes.at("all"));
  CHECK_THAT(outcome.out, Catch::Contains("projectile: ball.json") && Catch::Contains("grid to particles") &&
                              Catch::Contains("fit into 16 GB"));
}

TEST_CASE("on a machine that others keep busy the benchmark says that it was too busy to trust", "[slow]")
{
  const TemporaryFolder folder;
  // In enough steps to lose the core while they run.
  nlohmann::json slow_ball = nlohmann::json::parse(falling_ball);
  slow_ball["time"]["maximum_step"] = 2e-5;
  const std::string scene = folder.write("ball.json", slow_ball.dump()).string();
  const std::string file = (folder.path() / "bench.json").string();
  const std::string loop = folder.write("loop.sh", "while :; do :; done").string();
  std::deque<BackgroundProgram> others;
  for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) others.emplace_back("/bin/sh", loop);

  const Outcome outcome = tamp_with("bench projectile --scene " + scene + " --steps 4 --rounds 1 --json " + file);

  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file)).at("projectile");
  CHECK(json.at("core_share") < 0.9);
  CHECK(json.at("too_busy") == true);
  CHECK_THAT(outcome.out, Catch::Contains("too busy to trust"));
}

TEST_CASE("a benchmark of a scene that is not there, or of windows without steps, is refused")
{
  CHECK(tamp_with("bench punch --scene no-such-scene.json").exit_code == 2);
  CHECK(tamp_with("bench punch --steps 0").exit_code == 2);
}

TEST_CASE(
    "a thread multiplies and adds more than once in a microsecond, and less than a thousand times in a nanosecond")
{
  const double rate = tamp::tools::bench::multiplies_and_adds_per_second();

  CHECK(rate > 1e6);
  CHECK(rate < 1e12);
}

}  // namespace test_bench_windows
