#include <catch2/catch.hpp>

#include "tests/tools/impact.hpp"
#include "tests/tools/program.hpp"

namespace test_charts
{

using namespace tamp;
using Catch::Contains;

namespace
{

/// A short comparison, with variables of the environment set before it.
test::Outcome compare_with(const std::string& variables, const test::TemporaryFolder& folder)
{
  return test::outcome_of(variables + " " + TAMP_PROGRAM + " compare " + test::write_impact(folder).string() +
                          " --models table --steps 3 --threads 1 --quiet --out " + (folder.path() / "out").string());
}

/// An interpreter that does nothing but end with a code.
std::string ends_with(int code, const test::TemporaryFolder& folder)
{
  const auto file = folder.write("python", "#!/bin/sh\nexit " + std::to_string(code) + "\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file.string();
}

}  // namespace

TEST_CASE("without Python a comparison ends with 4 and says how to draw it, and keeps its figures")
{
  const test::TemporaryFolder folder;

  const test::Outcome outcome = compare_with("TAMP_PYTHON=/nonexistent/python PATH=", folder);

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err,
             Catch::StartsWith("tamp: " + (folder.path() / "out").string() + ": its figures are written") &&
                 Contains("python3-matplotlib") && Contains("tools/python/tamp draw "));
  CHECK_THAT(test::read_text(folder.path() / "out/compare.csv"), Contains("\ntable,completed,"));
  CHECK_THAT(test::read_text(folder.path() / "out/compare.json"), Contains("\"models\""));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "out/report.html"));
}

TEST_CASE("the command that a missing Python leaves behind draws the page")
{
  const test::TemporaryFolder folder;
  const std::string err = compare_with("TAMP_PYTHON=/nonexistent/python", folder).err;
  const std::size_t command = err.find("/usr/bin/python3 /");
  REQUIRE(command != std::string::npos);

  const test::Outcome outcome = test::outcome_of(err.substr(command, err.find('\n', command) - command));

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(test::read_text(folder.path() / "out/report.html"), Contains("Depth of block"));
}

TEST_CASE("a Python without matplotlib is distinguished from one whose drawing fails")
{
  const test::TemporaryFolder lacks, fails;

  const test::Outcome lacking = compare_with("TAMP_PYTHON=" + ends_with(3, lacks), lacks);
  const test::Outcome failing = compare_with("TAMP_PYTHON=" + ends_with(1, fails), fails);

  CHECK(lacking.exit_code == 4);
  CHECK_THAT(lacking.err, Contains("for want of Python with matplotlib"));
  CHECK(failing.exit_code == 4);
  CHECK_THAT(failing.err, Contains("could not be drawn; to try again:"));
}

}  // namespace test_charts
