#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"
#include "tools/bench/peers.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_peers
{

using namespace tamp;
using namespace tamp::test;

namespace
{

struct Difference {
  /// Root mean squares over the particles: how far they have moved, and how far apart the programs have them [m].
  double moved, apart;
  /// And of their pressures, and the differences of these [Pa].
  double pressure, pressure_apart;
};

std::span<const double> numbers(const runtime::ParticleBlock& block, const char* name)
{
  return std::get<std::span<const double>>(std::ranges::find(block.columns, name, &runtime::Column::name)->values);
}

/// Between TAMP's APIC and the plain program, after so many steps of a scene.
template <int D>
Difference after_steps(const std::filesystem::path& path, const std::vector<std::string>& assignments, int n_steps)
{
  const auto simulation = tasks::Simulation::make(tools::read_scene(path, assignments).scene, 1);
  auto plain = tools::bench::plain_of<D>(*simulation);
  const auto start = plain.particles();
  const tasks::Scene& scene = simulation->scene();
  for (int i = 0; i < n_steps; ++i) {
    simulation->advance(scene.time.end);
    plain.step(simulation->last_step_size());
  }

  const runtime::ParticleBlock block = simulation->particle_columns().front();
  const auto position = numbers(block, "position"), stress = numbers(block, "stress");
  const std::size_t n_stress = stress.size() / block.n;
  REQUIRE(block.n == start.size());
  Difference difference{};
  for (std::size_t p = 0; p < block.n; ++p) {
    const auto& particle = plain.particles()[p];
    for (std::size_t k = 0; k < D; ++k) {
      const double x = position[p * D + k] - scene.grid.lower[k];
      difference.moved += std::pow(x - start[p].position[k], 2) / static_cast<double>(block.n);
      difference.apart += std::pow(x - particle.position[k], 2) / static_cast<double>(block.n);
    }
    const double* s = stress.data() + p * n_stress;
    const double pressure = -(s[0] + s[1] + s[2]) / 3;
    const double of_plain = -(particle.stress[0] + particle.stress[1] + particle.stress[2]) / 3;
    difference.pressure += pressure * pressure / static_cast<double>(block.n);
    difference.pressure_apart += std::pow(pressure - of_plain, 2) / static_cast<double>(block.n);
  }
  for (double* mean : {&difference.moved, &difference.apart, &difference.pressure, &difference.pressure_apart}) {
    *mean = std::sqrt(*mean);
  }
  return difference;
}

}  // namespace

TEST_CASE("the plain MLS-MPM moves and presses a block that lands on its floor as TAMP's APIC does")
{
  // To as much as gradients of splines and moments of their weights differ on eight or ten cells.
  const Difference plane = after_steps<2>(
      TAMP_SOURCE_DIR "/inputs/peers/block.json",
      {"/grid/upper=[0.18,0.14]", "/bodies/block/geometry/lower=[0.04,0]", "/bodies/block/geometry/upper=[0.14,0.1]"},
      60);
  CAPTURE(plane.moved, plane.apart, plane.pressure, plane.pressure_apart);
  CHECK(plane.apart < 0.03 * plane.moved);
  CHECK(plane.pressure_apart < 0.08 * plane.pressure);

  const Difference space = after_steps<3>(TAMP_SOURCE_DIR "/inputs/peers/block_3d.json",
                                          {"/grid/upper=[0.16,0.16,0.12]", "/bodies/block/geometry/lower=[0.04,0.04,0]",
                                           "/bodies/block/geometry/upper=[0.12,0.12,0.08]"},
                                          60);
  CAPTURE(space.moved, space.apart, space.pressure, space.pressure_apart);
  CHECK(space.apart < 0.03 * space.moved);
  CHECK(space.pressure_apart < 0.08 * space.pressure);
}

TEST_CASE("the benchmark of peers has each program in the plane and in space, in a table and a file")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "bench.json").string();

  const Outcome outcome = tamp_with("bench peers --rounds 1 --steps 2 --particles 400 --json " + file);

  REQUIRE(outcome.exit_code == 0);
  const auto rows = nlohmann::json::parse(read_text(file)).at("peers");
  REQUIRE(rows.size() == 6);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].at("dimension") == (i < 3 ? 2 : 3));
    CHECK(rows[i].at("particles") == (i < 3 ? 400 : 512));
    CHECK(rows[i].at("ns_per_particle_step") > 0.0);
    CHECK(rows[i].at("of_plain").get<double>() == Approx(rows[i].at("ns_per_particle_step").get<double>() /
                                                         rows[i / 3 * 3].at("ns_per_particle_step").get<double>()));
  }
  CHECK(rows[0].at("program") == "plain MLS-MPM");
  CHECK(rows[2].at("program") == "tamp, apic");
  CHECK_THAT(outcome.out, Catch::Contains("plain MLS-MPM") && Catch::Contains("tamp, flip"));
}

}  // namespace test_peers
