#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "tasks/report/field_columns.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_flaw_fields
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// On 2 x 2 patches of 8 x 8 cells, sampled after every step.
Scene on_patches()
{
  Scene scene = empty_scene(2, {16, 16, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.limits.sampled_every = 1;
  return scene;
}

/// A block of rubber that is pulled apart along x, and bends.
Scene torn_block()
{
  Scene scene = on_patches();
  add_box(scene, add_elastic(scene, 1000, 1e4, 0.3), {0.4, 0.4, 0}, {1.2, 1.2, 0});
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) {
    return Vector<3>(20 * (x[0] - 0.8), 5 * (x[0] - 0.8) * (x[0] - 0.8), 0);
  };
  return scene;
}

double sum(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace

TEST_CASE("fields show which particles are torn and where pressure is uneven: just what the monitors sum up")
{
  const auto simulation = Simulation::make(torn_block(), 2);
  advance_to(*simulation, 0.085);
  const MonitorRecords before = simulation->monitors();

  simulation->advance(1e30);

  const MonitorRecords& after = simulation->monitors();
  const std::vector<double> torn = numbers_of(*simulation, "torn_apart");
  CHECK(sum(torn) > 0);
  CHECK(sum(torn) < static_cast<double>(torn.size()));
  CHECK(sum(torn) == after.torn_apart.all.part - before.torn_apart.all.part);

  const std::vector<double> uneven = numbers_of(*simulation, "uneven_pressure"),
                            density = numbers_of(*simulation, "density");
  constexpr double mass = 1000 * 0.05 * 0.05;
  double squares = 0, mean = 0;
  for (std::size_t p = 0; p < uneven.size(); ++p) {
    squares += mass / density[p] * uneven[p] * uneven[p];
    mean += mass / density[p] * uneven[p];
  }
  CHECK(squares > 0);
  CHECK(squares == Approx(after.uneven_pressure.all.part - before.uneven_pressure.all.part).epsilon(1e-9));
  CHECK(std::abs(mean) < 1e-12 * std::sqrt(squares));
}

TEST_CASE(
    "a field shows which sand is pressed beyond the range of its modulus, and the monitor names one such particle")
{
  Scene scene = on_patches();
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  scene.limits.out_of_range = 1e-6;
  add_box(scene, 0, {0.4, 0.4, 0}, {1.2, 1.2, 0});
  // The left half is pressed together, the right half pulled.
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) {
    return Vector<3>(0, (x[0] < 0.8 ? -4000 : 4000) * (x[1] - 0.8), 0);
  };
  const auto simulation = Simulation::make(scene, 2);

  advance_to(*simulation, 2e-4);

  const auto out = numbers_of(*simulation, "out_of_range"), p = numbers_of(*simulation, "p");
  const Occurrences& seen = simulation->monitors().out_of_range;
  CHECK(sum(out) > 0);
  CHECK(sum(out) < 0.75 * static_cast<double>(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == 1) CHECK(p[i] >= 0);
  }
  CHECK(seen.first.particle >= 0);
  CHECK(seen.first.material == 0);
  CHECK(seen.first.position[0] < 0.9);
}

TEST_CASE("sand that has dilated below what was tested is told from sand beyond the largest strain, and counted apart")
{
  Scene scene = on_patches();
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  scene.limits.looser_than_tested = scene.limits.out_of_range = 1e-6;
  add_box(scene, 0, {0.4, 0.4, 0}, {1.2, 1.2, 0});
  // The left half is crushed; the right half is sheared, which dilates it under pressure.
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) {
    return x[0] < 0.8 ? Vector<3>(0, -4000 * (x[1] - 0.8), 0) : Vector<3>(400 * (x[1] - 0.8), 0, 0);
  };
  const auto simulation = Simulation::make(scene, 2);
  double most = 0, most_by_looser = 0, n_looser = 0, n_beyond = 0;

  while (simulation->time() < 4e-4) {
    simulation->advance(4e-4);
    const auto looser = numbers_of(*simulation, "looser_than_tested"), beyond = numbers_of(*simulation, "out_of_range"),
               p = numbers_of(*simulation, "p"), density = numbers_of(*simulation, "density"),
               plastic = numbers_of(*simulation, "plastic_volumetric");
    double borne = 0, by_looser = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double own = 1624 * 0.05 * 0.05 / density[i] * std::max(p[i], 0.0);
      borne += own;
      by_looser += looser[i] * own;
      CHECK(looser[i] == (p[i] >= 0 && plastic[i] < 0 ? 1 : 0));
      CHECK(looser[i] + beyond[i] <= 1);
    }
    most = std::max(most, borne);
    most_by_looser = std::max(most_by_looser, by_looser);
    n_looser += sum(looser);
    n_beyond += sum(beyond);
  }

  const MonitorRecords& seen = simulation->monitors();
  CHECK(n_looser > 0);
  CHECK(n_beyond > 0);
  CHECK(static_cast<double>(simulation->updates().looser) == n_looser);
  CHECK(static_cast<double>(n_out_of_range(simulation->updates())) == n_beyond);
  CHECK(seen.looser_than_tested.greatest.part == Approx(most_by_looser));
  CHECK(seen.looser_than_tested.greatest.whole == Approx(most));
  CHECK(seen.looser_than_tested.above.first.particle >= 0);
  CHECK(seen.out_of_range.first.position[0] < 0.9);
}

TEST_CASE("what loose sand bears is held against the most that sand has borne, not against what is left of it")
{
  BorneShare borne;

  borne.add({1, 100}, 0.2, 50, 0.1, {});
  borne.add({9, 10}, 0.2, 100, 0.2, {});

  CHECK(borne.greatest.value() == 0.09);
  CHECK(borne.above.count == 0);
  borne.add({30, 40}, 0.2, 150, 0.3, {});
  CHECK(borne.greatest.value() == 0.3);
  CHECK(borne.above.first_step == 150);
}

TEST_CASE("materials that flow have no field of tears, and rigid bodies none of flaws")
{
  Scene scene = torn_block();
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  scene.materials.push_back(scene.materials[0]);
  add_box(scene, 1, {0.4, 0.1, 0}, {1.2, 0.3, 0});
  add_box(scene, 2, {0.4, 1.3, 0}, {1.2, 1.5, 0}).rigid = true;
  const auto has = [&](int material, const std::string& field) {
    return std::ranges::any_of(particle_field_names(scene, material),
                               [&](const FieldName& known) { return known.name == field; });
  };

  CHECK(has(0, "torn_apart"));
  CHECK(has(0, "uneven_pressure"));
  CHECK_FALSE(has(0, "out_of_range"));
  CHECK_FALSE(has(0, "looser_than_tested"));
  CHECK_FALSE(has(1, "torn_apart"));
  CHECK(has(1, "uneven_pressure"));
  CHECK(has(1, "out_of_range"));
  CHECK(has(1, "looser_than_tested"));
  CHECK_FALSE(has(2, "torn_apart"));
  CHECK_FALSE(has(2, "uneven_pressure"));
}

}  // namespace test_flaw_fields
