#include "tools/run/run_output.hpp"

#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "tests/runtime/storage/datasets.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/run/forecast.hpp"

namespace test_run_output
{

using namespace tamp;

namespace
{

tasks::Scene falling_disk()
{
  tasks::Scene scene = test::empty_scene(2, {8, 8, 1}, 0.1);
  test::add_disk(scene, test::add_elastic(scene, 1000, 1e6, 0.3), 0.4, 0.4, 0.2, {0, -1, 0});
  return scene;
}

/// A run that writes fields and its state after every step.
class SmallRun
{
 public:
  explicit SmallRun(
      bool in_background, const std::function<void()>& expect_own = [] {})
      : simulation_(tasks::Simulation::make(falling_disk(), executor_)),
        output_(*simulation_, *executor_, {folder_.path(), in_background, 2, expect_own})
  {
    output_.begin();
  }

  void write_steps(int n)
  {
    for (int step = 0; step < n; ++step) {
      simulation_->advance(1);
      output_.write_fields(true);
      output_.write_checkpoint("disk", {});
    }
    output_.finish();
  }

  auto fields() const { return test::all_datasets(folder_.path() / "fields.h5"); }
  /// All but the host's bytes, of which those between values may be any.
  auto checkpoint(const std::string& step) const
  {
    auto datasets = test::all_datasets(folder_.path() / "checkpoints" / ("step_0000000" + step + ".h5"));
    datasets.erase("host");
    return datasets;
  }
  tools::RunOutput& output() { return output_; }

 private:
  test::TemporaryFolder folder_;
  std::shared_ptr<runtime::Executor> executor_ = std::make_shared<runtime::Executor>(1);
  std::unique_ptr<tasks::Simulation> simulation_;
  tools::RunOutput output_;
};

}  // namespace

TEST_CASE("what is written in the background is what is written at once")
{
  SmallRun background(true), at_once(false);

  background.write_steps(3);
  at_once.write_steps(3);

  CHECK(background.fields() == at_once.fields());
  CHECK(background.fields().size() == 3 * (10 + 2) + 1);
  CHECK(background.checkpoint("2") == at_once.checkpoint("2"));
  CHECK(background.checkpoint("3") == at_once.checkpoint("3"));
  CHECK(at_once.output().time().waited == 0);
}

TEST_CASE("nothing is written in the background into a folder that is another's")
{
  SmallRun run(true, [] { throw runtime::FileError("run", "was taken over"); });

  CHECK_THROWS_WITH(run.write_steps(1), Catch::Contains("was taken over"));
  CHECK(run.output().has_failed());
  CHECK(run.fields().empty());
}

TEST_CASE("output is written in the background as far as there is memory for copies")
{
  tools::Forecast small, large;
  small.memory = large.memory = 1000;
  small.copies = 500;
  large.copies = 1e18;

  tools::add_copies(small);
  tools::add_copies(large);

  CHECK(small.in_background);
  CHECK(small.memory == 1500);
  CHECK_FALSE(large.in_background);
  CHECK(large.memory == 1000);
  CHECK_THAT(description(large), Catch::Contains("no room for copies"));
}

}  // namespace test_run_output
