#include <catch2/catch.hpp>
#include <csignal>

#include "tests/tools/temporary_folder.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/signals.hpp"

namespace test_child_process
{

using namespace tamp::tools;

TEST_CASE("a child that is asked to stop as it begins does not do its work")
{
  const tamp::test::TemporaryFolder folder;
  const auto done = folder.path() / "done";
  const Child first{.arguments = {}, .program = "/bin/true"},
      second{.arguments = {"-c", "sleep 5; touch " + done.string()}, .program = "/bin/sh"};

  // The second one has been started when the signal is looked for, and is asked to stop at once.
  CHECK_THROWS_AS(run_children({first, second}, 1, [](std::size_t, const ChildEnd&) { std::raise(SIGTERM); }),
                  Interrupted);

  CHECK_FALSE(std::filesystem::exists(done));
}

}  // namespace test_child_process
