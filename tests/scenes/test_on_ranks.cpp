#include <catch2/catch.hpp>

#include "tasks/simulation.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_on_ranks
{

using namespace tamp;

TEST_CASE("every shipped scene has the same digest on any ranks and threads", "[ranks][slow]")
{
  struct Shipped {
    const char* file;
    int n_steps;
  };
  const Shipped shipped = GENERATE(Shipped{"quick.json", 60}, Shipped{"half.json", 60}, Shipped{"table.json", 12},
                                   Shipped{"svr.json", 12}, Shipped{"mlp.json", 12});
  const auto checked = tools::read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/punch" / shipped.file, {});
  const auto digest = [&](int n_threads, const runtime::Communicator& communicator) {
    const auto simulation = tasks::Simulation::make(
        checked.scene, std::make_shared<runtime::Executor>(n_threads, test::on_shared_cores()), communicator);
    for (int n = 0; n < test::n_steps_of(shipped.n_steps); ++n) simulation->advance(1);
    return simulation->digest();
  };
  const std::string alone = digest(1, {});

  INFO(shipped.file);
  for (const int n_threads : {1, 2, 3}) CHECK(digest(n_threads, runtime::Communicator::world()) == alone);
}

}  // namespace test_on_ranks
