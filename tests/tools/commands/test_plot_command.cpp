#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/impact.hpp"
#include "tests/tools/program.hpp"

namespace test_plot_command
{

using namespace tamp::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{

const std::string heading = "step,time[s],ball.depth[m],ball.contact_force_y[N]\n";

/// The folder of a run that has written a history.
std::string run_with(const TemporaryFolder& folder, const std::string& history, const std::string& name = "ball")
{
  return folder.write(name + "/history.csv", history).parent_path().string();
}

std::string sound_run(const TemporaryFolder& folder, const std::string& name = "ball")
{
  return run_with(folder, heading + "0,0,0,0\n10,0.1,0.001,5\n20,0.2,0.002,9\n", name);
}

/// In the folder, so that places in messages are short.
Outcome plot_in(const TemporaryFolder& folder, const std::string& arguments)
{
  return outcome_of("cd " + folder.path().string() + " && " TAMP_PROGRAM " plot " + arguments);
}

}  // namespace

TEST_CASE("a force over the depth of a run is drawn by one line, and of two runs with a test beside them by another",
          "[slow]")
{
  const TemporaryFolder folder;
  sound_run(folder, "loose");
  sound_run(folder, "dense");
  folder.write("test.csv", "depth[mm],force[kN]\n1,0.004\n2,0.008\n");

  const Outcome one = plot_in(folder, "loose ball.depth ball.contact_force_y --out curve.svg");
  const Outcome all =
      plot_in(folder, "loose dense ball.depth[m] ball.contact_force_y --measured test.csv --out all.svg");
  const Outcome pixels = plot_in(folder, "loose ball.depth time --out curve.png");

  for (const Outcome& outcome : {one, all, pixels}) {
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
  }
  CHECK(one.out == "written to curve.svg\n");
  CHECK_THAT(read_text(folder.path() / "curve.svg"), Contains("ball.contact_force_y over ball.depth"));
  CHECK_THAT(read_text(folder.path() / "all.svg"), Contains("loose, 3 rows:") && Contains("dense, 3 rows:") &&
                                                       Contains("test.csv, 2 measured points:") &&
                                                       Contains("between 4 N and 8 N"));
  CHECK_THAT(read_text(folder.path() / "curve.png"), Catch::StartsWith("\x89PNG"));
}

TEST_CASE("a run that the program has made is plotted as it is, with what the machine took", "[slow]")
{
  const TemporaryFolder folder;
  const std::string run = "run " + write_impact(folder).string() + " --steps 3 --threads 1 --quiet --out ";
  REQUIRE(tamp_with(run + (folder.path() / "impact").string()).exit_code == 0);

  const Outcome force = plot_in(folder, "impact block.depth block.contact_force_y");
  const Outcome wall = plot_in(folder, "impact time wall");

  INFO(force.err + wall.err);
  CHECK(force.exit_code == 0);
  CHECK(force.out == "written to block.contact_force_y-over-block.depth.svg\n");
  CHECK(wall.exit_code == 0);
  CHECK(fs::exists(folder.path() / "wall-over-time.svg"));
}

TEST_CASE("a plot of what is not there ends with 2, and says where and what there is", "[slow]")
{
  const TemporaryFolder folder;
  sound_run(folder);
  run_with(folder, "step,time[s],block.depth[m]\n0,0,0\n", "block");
  folder.write("bare/notes.txt", "");
  const std::vector<std::array<std::string, 2>> all{
      {"ball ball.dept time",
       "ball/history.csv:1: no column ball.dept; expected one of its columns, such as ball.depth"},
      {"ball ball.depth[mm] time", "ball/history.csv:1: no column ball.depth[mm]; expected ball.depth[m]"},
      {"ball block time ball.depth",
       "block/history.csv:1: no column ball.depth, which ball has; expected one of its columns, such as block.depth"},
      {"ball ball time ball.depth", "ball: given twice; expected each run once"},
      {"bare time step", "bare/history.csv: no such file"},
      {"none time step", "none: no such folder; expected the folder of a run"},
      {"ball/history.csv time step", "ball/history.csv: a file; expected the folder of a run"},
      {"ball time step --measured none.csv", "none.csv: no such file"},
      {"ball time step --out curve.pdf", "--out: curve.pdf; expected a name that ends in .svg or .png"}};

  for (const auto& [arguments, said] : all) {
    INFO(arguments);
    const Outcome outcome = plot_in(folder, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + said));
  }
}

TEST_CASE("a plot without a run or a column ends with 2 and names what is missing")
{
  CHECK(tamp_with("plot").err == "tamp: RUN is required; see tamp help plot\n");
  for (const char* arguments : {"runs/ball", "runs/ball ball.depth"}) {
    const Outcome outcome = tamp_with(std::string("plot ") + arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err == "tamp: RUN... X Y is required; see tamp help plot\n");
  }
  CHECK_THAT(tamp_with("help plot").out, Contains("Usage: tamp plot [OPTIONS] RUN... X Y\n"));
}

TEST_CASE("a measured CSV without units, or with others than the columns have, is refused by its line", "[slow]")
{
  const TemporaryFolder folder;
  sound_run(folder);
  const auto said_of = [&](const std::string& content) {
    folder.write("test.csv", content);
    const Outcome outcome = plot_in(folder, "ball ball.depth ball.contact_force_y --measured test.csv --out a.svg");
    CHECK(outcome.exit_code == 2);
    CHECK_FALSE(fs::exists(folder.path() / "a.svg"));
    return outcome.err;
  };

  CHECK(said_of("depth,force\n1,2\n") ==
        "tamp: test.csv:1: \"depth\" without a unit; expected names with units, such as depth[mm],force[kN]\n");
  CHECK_THAT(said_of("depth[mm],force[MPa]\n1,2\n"),
             Catch::StartsWith("tamp: test.csv:1: \"force[MPa]\" beside ball.contact_force_y[N]"));
  CHECK_THAT(said_of("depth[mm],force[N]\n1,2\n1,x\n"), Catch::StartsWith("tamp: test.csv:3: \"x\""));
}

TEST_CASE("a damaged history ends a plot with 4 at its row, and one whose last line is cut off is drawn without it",
          "[slow]")
{
  const TemporaryFolder folder;
  run_with(folder, "", "empty");
  run_with(folder, heading + "0,0,0,0\n1,2,3\n", "ragged");
  run_with(folder, heading + "0,0,0,0\n1,2,3,4\n2,3", "cut");

  const Outcome empty = plot_in(folder, "empty time step"), ragged = plot_in(folder, "ragged time step");
  const Outcome cut = plot_in(folder, "cut time step");

  CHECK(empty.exit_code == 4);
  CHECK(empty.err == "tamp: empty/history.csv: no heading; expected what TAMP has written\n");
  CHECK(ragged.exit_code == 4);
  CHECK(ragged.err == "tamp: ragged/history.csv:3: 3 values; expected 4, as TAMP has written them\n");
  CHECK(cut.exit_code == 0);
  CHECK(cut.err == "tamp: cut/history.csv:4: warning: cut off, and left out\n");
  CHECK_THAT(read_text(folder.path() / "step-over-time.svg"), Contains("cut, 2 rows:"));
}

TEST_CASE("a plot replaces pictures alone, and none of the files that it reads", "[slow]")
{
  const TemporaryFolder folder;
  sound_run(folder);
  const fs::path notes = folder.write("notes.svg", "mine"), data = folder.write("data.svg", "time[s],step[-]\n1,2\n");
  const std::string line = "ball time step --measured data.svg --out ";

  const Outcome over_notes = plot_in(folder, line + "notes.svg"), over_data = plot_in(folder, line + "data.svg");

  CHECK(over_notes.exit_code == 2);
  CHECK(over_notes.err == "tamp: notes.svg: holds something else than a picture; expected another file to write to\n");
  CHECK(over_data.exit_code == 2);
  CHECK(over_data.err == "tamp: data.svg: an input; expected another file to write to\n");
  CHECK(read_text(notes) == "mine");
  CHECK_THAT(read_text(data), Catch::StartsWith("time[s]"));
  CHECK(plot_in(folder, line + "new.svg").exit_code == 0);
  CHECK(plot_in(folder, line + "new.svg").exit_code == 0);
  CHECK(plot_in(folder, line + "no/new.svg").exit_code == 4);
}

TEST_CASE("without Python with matplotlib a plot ends with 4 and says what to install")
{
  const TemporaryFolder folder;
  const std::string line = TAMP_PROGRAM " plot " + sound_run(folder) + " time step --out curve.svg";
  const fs::path fails = folder.write("python", "#!/bin/sh\nexit 1\n");
  fs::permissions(fails, fs::perms::owner_all);

  const Outcome lacking = outcome_of("TAMP_PYTHON=/nonexistent/python " + line);
  const Outcome failing = outcome_of("TAMP_PYTHON=" + fails.string() + " " + line);

  CHECK(lacking.exit_code == 4);
  CHECK_THAT(lacking.err, Catch::StartsWith("tamp: curve.svg: not drawn") && Contains("python3-matplotlib"));
  CHECK(failing.exit_code == 4);
  CHECK_THAT(failing.err, Catch::StartsWith("tamp: curve.svg: could not be drawn; to try again: "));
}

}  // namespace test_plot_command
