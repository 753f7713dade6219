#include <catch2/catch.hpp>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_sparse_patches
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double h = 0.1;

/// A small disk that flies through otherwise empty patches.
Scene lone_disk()
{
  Scene scene = empty_scene(2, {32, 24, 1}, h);
  scene.n_patches = {8, 6, 1};
  add_disk(scene, add_elastic(scene, 1000, 1e6, 0.3), 0.8, 0.8, 0.25, {8, 3, 0});
  return scene;
}

std::unique_ptr<Simulation> on_all_ranks(const Scene& scene)
{
  return Simulation::make(scene, std::make_shared<runtime::Executor>(2, on_shared_cores()),
                          runtime::Communicator::world());
}

/// Mass and momentum that the nodes of all ranks show.
Eigen::Vector3d shown_by_nodes(Simulation& simulation)
{
  const runtime::FieldCopy fields = simulation.fields({}, true);
  const auto density = std::get<std::span<const double>>(fields.nodes->columns[0].values);
  const auto velocity = std::get<std::span<const double>>(fields.nodes->columns[1].values);
  std::array<double, 3> own{};
  for (std::size_t i = 0; i < density.size(); ++i) {
    const double mass = density[i] * h * h;
    own[0] += mass;
    own[1] += mass * velocity[2 * i];
    own[2] += mass * velocity[2 * i + 1];
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& part : simulation.communicator().gather_value(own)) sum += Eigen::Vector3d(part.data());
  return sum;
}

/// Bytes of fields in this rank's ledger, once all graphs have been run.
std::size_t of_fields(Simulation& simulation)
{
  runtime::Engine& engine = simulation.engine();
  for (std::size_t g = 1; g < engine.graphs().size(); ++g) engine.run(g, simulation.last_step_size());
  runtime::MemoryLedger& ledger = engine.warehouse().ledger();
  std::size_t bytes = ledger.total().current();
  for (const char* other :
       {"graph and profile", "messages", "copies for output", "trace", "zeros", "particles that change patches"}) {
    bytes -= ledger.entry(other).current();
  }
  return bytes;
}

}  // namespace

TEST_CASE("node fields are stored where there is matter, as forecast, and given back behind it")
{
  const auto simulation = Simulation::make(lone_disk(), 2);
  runtime::MemoryLedger& ledger = simulation->engine().warehouse().ledger();
  const runtime::LedgerEntry& sums = ledger.entry("node sums");
  CHECK(sums.current() == 0);

  simulation->advance(1);

  // The disk, with the nodes that it gives to, takes up to nine of 48 patches.
  const std::size_t of_first_step = sums.current();
  const double of_a_patch = 7 * 7 * 2.0 * sizeof(components::NodeSums<2>);
  CHECK(static_cast<double>(of_first_step) > 4 * of_a_patch);
  CHECK(static_cast<double>(of_first_step) < 12 * of_a_patch);
  CHECK(static_cast<double>(of_fields(*simulation)) ==
        Approx(static_cast<double>(simulation->forecast_bytes())).epsilon(0.01));

  advance_to(*simulation, 0.2);

  CHECK(static_cast<double>(sums.current()) < 2.0 * static_cast<double>(of_first_step));
}

TEST_CASE("the memory of fields is forecast with what messages bring", "[ranks]")
{
  const auto simulation = on_all_ranks(lone_disk());

  simulation->advance(1);

  const auto now = static_cast<double>(simulation->communicator().sum(of_fields(*simulation)));
  CHECK(now == Approx(static_cast<double>(simulation->forecast_bytes())).epsilon(0.01));
}

TEST_CASE("patches that particles have crossed give their memory back")
{
  const auto simulation = Simulation::make(lone_disk(), 2);
  runtime::LedgerEntry& stress = simulation->engine().warehouse().ledger().entry("stress");
  const std::size_t at_start = stress.current();

  advance_to(*simulation, 0.2);

  CHECK(stress.current() < 2 * at_start);
  CHECK(stress.peak() < 3 * at_start);
}

TEST_CASE("nodes of patches that particles have left show nothing", "[ranks]")
{
  const auto simulation = on_all_ranks(lone_disk());
  const double mass = total_mass(simulation->report());
  const Eigen::Vector3d expected = mass * Eigen::Vector3d(1, 8, 3);

  // Through half of the patches along x.
  while (simulation->time() < 0.2) {
    simulation->advance(0.2);
    REQUIRE((shown_by_nodes(*simulation) - expected).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("the grid phases pass over patches that no particle is near", "[ranks]")
{
  const auto simulation = on_all_ranks(lone_disk());

  simulation->advance(1);

  const runtime::Profile profile = simulation->engine().profile();
  for (const char* name : {"particles to grid", "accelerate nodes", "contact", "walls", "grid to particles"}) {
    const auto task = std::find_if(profile.tasks.begin(), profile.tasks.end(),
                                   [&](const runtime::TaskStatistics& t) { return t.name == name; });
    REQUIRE(task != profile.tasks.end());
    // The disk lies on four patches, which lie among sixteen.
    CHECK(task->count <= 16);
    CHECK(task->count + task->skipped == 48);
  }
}

TEST_CASE("a rank is heard when all of its patches are empty", "[ranks]")
{
  const auto simulation = on_all_ranks(lone_disk());
  const runtime::Communicator& all = simulation->communicator();
  advance_to(*simulation, 0.5);
  REQUIRE(simulation->n_particles(0) == 0);
  const auto n_boxes = all.gather_value(simulation->fields({}, true).nodes->boxes->size());

  for (int speaker = 0; speaker < all.size(); ++speaker) {
    // A rank may have no patch at all.
    if (n_boxes[static_cast<std::size_t>(speaker)] == 0) continue;
    if (all.rank() == speaker) simulation->engine().ask(4);
    simulation->advance(1 + speaker);
    CHECK(simulation->engine().asked() == 4);
  }
}

}  // namespace test_sparse_patches
