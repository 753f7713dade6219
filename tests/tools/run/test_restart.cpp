#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tasks/simulation.hpp"
#include "tests/tools/background_program.hpp"
#include "tests/tools/program.hpp"
#include "tools/run/checkpointing.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_restart
{

using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

/// The quick punch, with the transfer that has particles keep most.
const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json --set /transfer=tflip";

std::string run_of(const fs::path& folder, const std::string& options)
{
  return "run " + scene + " --quiet --out " + folder.string() + " " + options;
}

std::string restart_of(const fs::path& folder, const std::string& options)
{
  return "run " + scene + " --quiet --restart " + folder.string() + " " + options;
}

nlohmann::json summary_of(const fs::path& folder)
{
  return nlohmann::json::parse(std::ifstream(folder / "summary.json"));
}

/// Waits for the first whole checkpoint of a run, as long as a slow machine may need.
bool keeps_its_state(const fs::path& run)
{
  for (int n = 0; n < 6000; ++n) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(run / "checkpoints", none)) {
      if (entry.path().extension() == ".h5") return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// A straight run of 150 steps, made once.
struct Straight {
  TemporaryFolder folder;
  std::string digest;
  std::string history;

  Straight()
  {
    REQUIRE(tamp_with(run_of(folder.path() / "run", "--steps 150")).exit_code == 0);
    digest = summary_of(folder.path() / "run")["state_digest"];
    history = read_text(folder.path() / "run/history.csv");
  }
};

const Straight& straight()
{
  static const Straight run;
  return run;
}

/// A run of 120 steps that is broken off at step 70 and goes on over so many ranks from step 60 ends as a straight one.
void check_parted_run(const std::string& scene_options, int n_ranks)
{
  const TemporaryFolder folder;
  const fs::path straight = folder.path() / "straight", parted = folder.path() / "parted";
  const std::string run = "run " + scene_options + " --quiet";

  REQUIRE(tamp_with(run + " --steps 120 --out " + straight.string()).exit_code == 0);
  REQUIRE(tamp_with(run + " --steps 70 --checkpoint-steps 60 --out " + parted.string()).exit_code == 0);
  REQUIRE(tamp_on_ranks(n_ranks, run + " --steps 120 --restart " + parted.string()).exit_code == 0);

  const nlohmann::json summary = summary_of(parted);
  CHECK(summary["restarted_at_step"] == 60);
  CHECK(summary["state_digest"] == summary_of(straight)["state_digest"]);
  CHECK(read_text(parted / "history.csv") == read_text(straight / "history.csv"));
}

void flip_a_byte(const fs::path& file)
{
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(fs::file_size(file) / 2);
  stream.seekg(middle);
  const int byte = stream.get();
  stream.seekp(middle);
  stream.put(static_cast<char>(byte ^ 0x40));
}

}  // namespace

TEST_CASE("a run that goes on, on other ranks and threads, ends with the bits of a straight one", "[mpiexec]")
{
  struct Crew {
    int ranks;
    int threads;
  };
  const auto [before, after] = GENERATE(std::pair{Crew{1, 2}, Crew{1, 1}}, std::pair{Crew{1, 1}, Crew{3, 2}},
                                        std::pair{Crew{2, 2}, Crew{1, 3}}, std::pair{Crew{4, 1}, Crew{2, 1}});
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const auto threads = [](const Crew& crew) { return " --threads " + std::to_string(crew.threads); };

  REQUIRE(tamp_on_ranks(before.ranks, run_of(run, "--steps 110 --checkpoint-steps 40" + threads(before))).exit_code ==
          0);
  REQUIRE(tamp_on_ranks(after.ranks, restart_of(run, "--steps 150" + threads(after))).exit_code == 0);

  const auto summary = summary_of(run);
  CHECK(summary["restarted_at_step"] == 80);
  CHECK(summary["ranks"] == after.ranks);
  CHECK(summary["state_digest"] == straight().digest);
  CHECK(read_text(run / "history.csv") == straight().history);
}

TEST_CASE("a run that was begun with an old word goes on under the new one", "[slow]")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  const std::string old = "run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --set /transfer=affine --quiet";
  REQUIRE(tamp_with(old + " --steps 80 --checkpoint-steps 40 --out " + run.string()).exit_code == 0);

  REQUIRE(tamp_with(restart_of(run, "--steps 150")).exit_code == 0);

  CHECK(summary_of(run)["restarted_at_step"] == 80);
  CHECK(summary_of(run)["state_digest"] == straight().digest);
}

TEST_CASE("a driven body goes on from where it was, on other ranks too, with the bits of a straight run", "[mpiexec]")
{
  check_parted_run(TAMP_SOURCE_DIR "/inputs/cone/quick.json --set /grid/cell_size=0.01", 2);
}

TEST_CASE("half a scene goes on from where it was, on other ranks too, with the bits of a straight run", "[mpiexec]")
{
  check_parted_run(TAMP_SOURCE_DIR "/inputs/punch/half.json", 2);
}

TEST_CASE("an axisymmetric scene goes on from where it was, on other ranks too, with the bits of a straight run",
          "[mpiexec]")
{
  check_parted_run(TAMP_SOURCE_DIR "/inputs/savings/projectile_straight_down.json", 2);
}

TEST_CASE("soil on walls goes on, on other ranks too, with the bits of a straight run", "[mpiexec]")
{
  const std::string transfer = GENERATE("tflip", "apic --set /stress_timing=musl", "tpic --set /stress_timing=usf",
                                        "fmpm --set /filter_order=3 --set /boundaries/y-=no_slip");
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "column.json";
  std::ofstream(file) << R"({
    "dimension": 2,
    "grid": {"upper": [3.2, 1.6], "cell_size": 0.1, "patches": [4, 2]},
    "boundaries": {"x-": "no_slip", "y-": {"friction": 0.5}, "y+": "open"},
    "time": {"end": 1},
    "interpolator": "quadratic_spline", "local_damping": 0.1,
    "gravity": [0, -9.81],
    "materials": {"soil": {"type": "drucker_prager", "density": 1600, "bulk_modulus": 1e6, "shear_modulus": 5e5,
                           "friction_angle": 30}},
    "bodies": {"column": {"material": "soil", "geometry": {"type": "box", "lower": [0, 0], "upper": [1, 1]}}}
  })";

  check_parted_run(file.string() + " --set /transfer=" + transfer, 3);
}

TEST_CASE("with any interpolator a run goes on, on other ranks too, with the bits of a straight run", "[mpiexec]")
{
  const std::string interpolator = GENERATE("linear", "cpgimp", "cpdi", "cubic_spline");
  const std::string rule = interpolator == "linear" ? " --set /time/rule=published" : "";

  check_parted_run(
      TAMP_SOURCE_DIR "/inputs/verification/axis_aligned/quick.json --set /interpolator=" + interpolator + rule, 2);
}

TEST_CASE("sand that has separated goes on with the bits of a straight run, on other ranks too", "[mpiexec]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.write("block.json", R"({
    "dimension": 2, "grid": {"upper": [0.8, 0.8], "cell_size": 0.05, "patches": [4, 2]}, "time": {"end": 1},
    "transfer": "tflip", "artificial_viscosity": {},
    "materials": {"sand": {"file": ")" TAMP_SOURCE_DIR R"(/inputs/materials/concrete-sand/table.json",
                           "separation": true}},
    "bodies": {"block": {"material": "sand", "angular_velocity": [1500],
                         "geometry": {"type": "box", "lower": [0.05, 0.3], "upper": [0.35, 0.5]}}}
  })");

  check_parted_run(file.string(), 3);

  REQUIRE(
      tamp_with("run " + file.string() + " --quiet --steps 60 --out " + (folder.path() / "run").string()).exit_code ==
      0);
  CHECK(summary_of(folder.path() / "run")["monitors"]["separations"] > 50);
}

TEST_CASE("a footing under a load that grows goes on with the bits of a straight run, on other ranks too", "[mpiexec]")
{
  check_parted_run(TAMP_SOURCE_DIR "/inputs/footing/quick.json --set /output/history_interval=0.0005", 3);
}

namespace
{

/// Value of a column in the last row of a table.
double last_value(const std::string& csv, const std::string& column)
{
  std::istringstream names(csv.substr(0, csv.find('\n')));
  std::istringstream values(csv.substr(csv.rfind('\n', csv.size() - 2) + 1));
  std::string name, value;
  while (std::getline(names, name, ',') && std::getline(values, value, ',')) {
    if (name == column) return std::stod(value);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST_CASE("bodies that go around a periodic domain go on with the bits of a straight run, on other ranks too",
          "[mpiexec]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.write("disk.json", R"({
    "dimension": 2, "grid": { "upper": [1.2, 0.6], "cell_size": 0.05, "patches": [4, 2] },
    "boundaries": { "x-": "periodic", "x+": "periodic" }, "time": { "end": 1 }, "gravity": [0, -9.81],
    "materials": { "rubber": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e6, "shear_modulus": 4e5 } },
    "bodies": { "disk": { "material": "rubber", "velocity": [30, -3],
                          "geometry": { "type": "ball", "centre": [0.6, 0.3], "radius": 0.2 } } }
  })");
  const std::string disk = "run " + file.string();
  const auto run = [&](const std::string& name) { return " --quiet --out " + (folder.path() / name).string(); };
  const std::string restart = " --quiet --restart " + (folder.path() / "parted").string();

  REQUIRE(tamp_with(disk + " --steps 600" + run("straight")).exit_code == 0);
  REQUIRE(tamp_on_ranks(3, disk + " --steps 300 --checkpoint-steps 80" + run("parted")).exit_code == 0);
  REQUIRE(tamp_on_ranks(2, disk + " --steps 600" + restart).exit_code == 0);

  const auto parted = summary_of(folder.path() / "parted"), straight = summary_of(folder.path() / "straight");
  CHECK(parted["restarted_at_step"] == 240);
  CHECK(parted["state_digest"] == straight["state_digest"]);
  const std::string history = read_text(folder.path() / "straight/history.csv");
  CHECK(read_text(folder.path() / "parted/history.csv") == history);
  // It has been around twice.
  CHECK(last_value(history, "disk.depth[m]") > 2.4);
}

TEST_CASE("a body that functions start and drive goes on with the bits of a straight run", "[mpiexec]")
{
  check_parted_run(TAMP_SOURCE_DIR "/inputs/verification/axis_aligned/quick.json", 2);
}

TEST_CASE("a checkpoint of a version that kept other things of the run is refused")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string quick = TAMP_SOURCE_DIR "/inputs/punch/quick.json";
  const auto checked = tamp::tools::read_scene(quick);
  const auto simulation = tamp::tasks::Simulation::make(checked.scene, 1);
  const std::vector<std::byte> of_other_version(8);
  simulation->engine().write_checkpoint(run / "checkpoints", tamp::tools::fingerprint(checked), of_other_version, 2);

  const Outcome outcome = tamp_with("run " + quick + " --quiet --restart " + run.string());

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("step_00000000.h5: a checkpoint of another version of tamp"));
}

TEST_CASE("a damaged checkpoint is refused with its reason, and the one before is used", "[slow]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  REQUIRE(tamp_with(run_of(run, "--steps 100 --checkpoint-steps 40")).exit_code == 0);
  flip_a_byte(run / "checkpoints/step_00000080.h5");

  const Outcome outcome = tamp_with(restart_of(run, "--steps 150"));

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Catch::Contains("step_00000080.h5") && Catch::Contains("checksum"));
  CHECK(fs::exists(run / "checkpoints/step_00000080.h5.damaged"));
  CHECK(summary_of(run)["restarted_at_step"] == 40);
  CHECK(summary_of(run)["state_digest"] == straight().digest);
}

TEST_CASE("a run of which no checkpoint can be read is damaged, and ends with 4")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  REQUIRE(tamp_with(run_of(run, "--steps 10 --checkpoint-steps 10")).exit_code == 0);
  flip_a_byte(run / "checkpoints/step_00000010.h5");

  const Outcome outcome = tamp_with(restart_of(run, "--steps 20"));

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("checksum") && Catch::Contains("none of its checkpoints can be read"));
}

TEST_CASE("a folder without a whole checkpoint, or of another scene, cannot be gone on with", "[slow]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const Outcome nothing = tamp_with(restart_of(run, ""));
  CHECK(nothing.exit_code == 2);
  CHECK_THAT(nothing.err, Catch::Contains("run: no such folder"));
  fs::create_directory(run);
  const Outcome empty = tamp_with(restart_of(run, ""));
  CHECK(empty.exit_code == 2);
  CHECK_THAT(empty.err, Catch::Contains("checkpoints: no whole checkpoint"));
  fs::remove_all(run);

  REQUIRE(tamp_with(run_of(run, "--steps 20 --checkpoint-steps 20")).exit_code == 0);
  const Outcome other = tamp_with(restart_of(run, "--set /gravity=[0,-1]"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Catch::Contains("a checkpoint of another scene"));
  CHECK(tamp_with(restart_of(run, "--steps 30 --set /time/end=6e-3")).exit_code == 0);
}

TEST_CASE("a run that is restarted at its end ends again as it did")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string end = "--until 2e-4 --checkpoint-time 1e-4";
  REQUIRE(tamp_with(run_of(run, end)).exit_code == 0);
  const auto before = summary_of(run);
  const std::string history = read_text(run / "history.csv");

  CHECK(tamp_with(restart_of(run, end)).exit_code == 0);

  const auto after = summary_of(run);
  CHECK(after["restarted_at_step"] == before["steps"]);
  CHECK(after["state_digest"] == before["state_digest"]);
  CHECK(after["energies_J"] == before["energies_J"]);
  CHECK(read_text(run / "history.csv") == history);
}

namespace
{

/// The inputs in a folder of their own, where they may be changed.
std::string own_inputs(const TemporaryFolder& folder, const std::string& name)
{
  fs::copy(TAMP_SOURCE_DIR "/inputs", folder.path() / name, fs::copy_options::recursive);
  return (folder.path() / name / "punch/quick.json").string();
}

void replace_in(const fs::path& file, const std::string& old_text, const std::string& new_text)
{
  std::string text = read_text(file);
  REQUIRE(text.find(old_text) != std::string::npos);
  text.replace(text.find(old_text), old_text.size(), new_text);
  std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("a run does not go on with data that have changed, and names the file; a copy elsewhere will do")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string first = own_inputs(folder, "first");
  REQUIRE(tamp_with("run " + first + " --quiet --steps 4 --checkpoint-steps 2 --out " + run.string()).exit_code == 0);
  const std::string second = own_inputs(folder, "second");
  const std::string go_on = " --quiet --steps 6 --restart " + run.string();

  CHECK(tamp_with("run " + second + go_on).exit_code == 0);
  const fs::path strengths = folder.path() / "second/materials/concrete-sand/yield.csv";
  std::ofstream(strengths, std::ios::app) << "# one more line\n";
  const Outcome changed = tamp_with("run " + second + go_on);
  const Outcome other = tamp_with("run " + first + " --set /grid/patches=[1,1]" + go_on);

  CHECK(changed.exit_code == 2);
  CHECK_THAT(changed.err, Catch::Contains(strengths.string() + ": its content has changed since the checkpoint"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Catch::Contains("a checkpoint of another scene, which differs at /grid/patches"));
  bool names_table = false;
  const auto summary = summary_of(run);
  for (const auto& input : summary["inputs"]) names_table |= input["file"].get<std::string>().ends_with("yield.csv");
  CHECK(names_table);
}

TEST_CASE("a run that goes on tells what is missing of its history and fields, and keeps the rest", "[slow]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string outputs = " --set /output/history_interval=1e-5 --set /output/fields_interval=1e-5 ";
  REQUIRE(tamp_with(run_of(run, "--steps 20 --checkpoint-steps 10" + outputs)).exit_code == 0);
  const std::string history = read_text(run / "history.csv");

  SECTION("nothing is missing")
  {
    const Outcome outcome = tamp_with(restart_of(run, "--steps 25" + outputs));
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(summary_of(run)["status"] == "completed");
    CHECK(read_text(run / "history.csv").starts_with(history.substr(0, history.size() / 2)));
  }
  SECTION("rows of the history")
  {
    replace_in(run / "history.csv", history.substr(history.find('\n'), 200), "\n");
    const Outcome outcome = tamp_with(restart_of(run, "--steps 30 --checkpoint-steps 10" + outputs));
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("history.csv: is damaged: of "));
    CHECK(summary_of(run)["status"] == "completed with warnings");
    CHECK(summary_of(run)["warnings"].size() == 1);
    CHECK(tamp_with(restart_of(run, "--strict --steps 31" + outputs)).exit_code == 0);
  }
  SECTION("all of the history, with --strict")
  {
    fs::remove(run / "history.csv");
    const Outcome outcome = tamp_with(restart_of(run, "--strict --steps 25" + outputs));
    CHECK(outcome.exit_code == 3);
    CHECK_THAT(outcome.err, Catch::Contains("history.csv: is missing, with the "));
  }
  SECTION("all of the fields")
  {
    fs::copy_file(run / "fields.h5", run / "other.h5");
    REQUIRE(tamp_with(run_of(folder.path() / "empty", "--steps 1")).exit_code == 0);
    fs::copy_file(folder.path() / "empty/fields.h5", run / "fields.h5", fs::copy_options::overwrite_existing);
    const Outcome outcome = tamp_with(restart_of(run, "--steps 25" + outputs));
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err,
               Catch::Contains("fields.h5: has 2 outputs until step") && Catch::Contains("that were written"));
  }
}

TEST_CASE("signals have a run keep its state and leave with 128 and their number", "[slow]")
{
  const int signal = GENERATE(SIGTERM, SIGINT, SIGHUP, SIGXCPU);
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  BackgroundProgram program(TAMP_PROGRAM, run_of(run, "--checkpoint-steps 5 --threads 1"));
  REQUIRE(keeps_its_state(run));

  program.send(signal);

  CHECK(program.exit_code() == 128 + signal);
  const auto summary = summary_of(run);
  CHECK(summary["status"] == "interrupted");
  REQUIRE(tamp_with(restart_of(run, "--steps " + std::to_string(summary["steps"].get<long>() + 1))).exit_code == 0);
  CHECK(summary_of(run)["restarted_at_step"] == summary["steps"]);
}

TEST_CASE("a hangup that is ignored, as under nohup, stays ignored")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const auto before = std::signal(SIGHUP, SIG_IGN);
  BackgroundProgram program(TAMP_PROGRAM, run_of(run, "--steps 60 --checkpoint-steps 5 --threads 1"));
  std::signal(SIGHUP, before);
  REQUIRE(keeps_its_state(run));

  program.send(SIGHUP);

  CHECK(program.exit_code() == 0);
  CHECK(summary_of(run)["steps"] == 60);
}

TEST_CASE("a run leaves at its wall limit as at SIGTERM, and is gone on with")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";

  const Outcome outcome = tamp_with(run_of(run, "--wall-limit 0.3 --threads 1"));

  CHECK(outcome.exit_code == 128 + SIGTERM);
  CHECK_THAT(outcome.err, Catch::Contains("stopped at its wall limit") && Catch::Contains("--restart"));
  const long steps = summary_of(run)["steps"];
  CHECK(tamp_with(restart_of(run, "--steps " + std::to_string(steps + 1))).exit_code == 0);
  CHECK(summary_of(run)["restarted_at_step"] == steps);
}

TEST_CASE("of runs that start at once in one folder, one has it, and the others say whose it is")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string arguments = run_of(run, "--steps 60 --threads 1");
  BackgroundProgram first(TAMP_PROGRAM, arguments), second(TAMP_PROGRAM, arguments), third(TAMP_PROGRAM, arguments);

  std::vector<int> codes{first.exit_code(), second.exit_code(), third.exit_code()};

  std::sort(codes.begin(), codes.end());
  CHECK(codes == std::vector<int>{0, 2, 2});
  CHECK(summary_of(run)["steps"] == 60);
  CHECK_FALSE(fs::exists(run / "run.lock"));
}

TEST_CASE("a run is not replaced or gone on with while it runs; killed, it is, and that is reported")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  {
    BackgroundProgram program(TAMP_PROGRAM, run_of(run, "--checkpoint-steps 5 --threads 1"));
    REQUIRE(keeps_its_state(run));
    for (const std::string& other : {run_of(run, "--force"), restart_of(run, "")}) {
      const Outcome outcome = tamp_with(other);
      CHECK(outcome.exit_code == 2);
      CHECK_THAT(outcome.err, Catch::Contains("run.lock: in use by process"));
    }
  }  // kill -9

  const Outcome outcome = tamp_with(restart_of(run, "--steps 40"));

  CHECK_THAT(outcome.err, Catch::Contains("the lock of a run that has ended was taken over"));
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a run that was stopped for so long that another took its folder leaves it alone")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  BackgroundProgram program(TAMP_PROGRAM, run_of(run, "--checkpoint-steps 5 --threads 1"));
  REQUIRE(keeps_its_state(run));
  program.send(SIGSTOP);
  fs::last_write_time(run / "run.lock", fs::file_time_type::clock::now() - std::chrono::minutes(2));

  const Outcome other = tamp_with(run_of(run, "--steps 20 --force"));
  program.send(SIGCONT);

  CHECK(other.exit_code == 0);
  CHECK(program.exit_code() == 4);
  CHECK(summary_of(run)["steps"] == 20);
}

TEST_CASE("SIGUSR2, which mpiexec hands on, stops a run on ranks with its state kept", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  allow_ranks_anywhere();
  BackgroundProgram program(TAMP_MPIEXEC, "-n 2 " TAMP_PROGRAM " " + run_of(run, "--checkpoint-steps 5 --threads 1"));
  REQUIRE(keeps_its_state(run));

  program.send(SIGUSR2);

  CHECK(program.exit_code() == 128 + SIGTERM);
  const auto summary = summary_of(run);
  CHECK(summary["status"] == "interrupted");
  REQUIRE(tamp_with(restart_of(run, "--steps " + std::to_string(summary["steps"].get<long>() + 1))).exit_code == 0);
  CHECK(summary_of(run)["restarted_at_step"] == summary["steps"]);
}

TEST_CASE("when one rank is killed all are gone within ten seconds, and the run can be gone on with", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  allow_ranks_anywhere();
  BackgroundProgram program(TAMP_MPIEXEC, "-n 3 " TAMP_PROGRAM " " + run_of(run, "--checkpoint-steps 10 --threads 1"));
  REQUIRE(keeps_its_state(run));
  const std::vector<pid_t> ranks = program.children();
  REQUIRE(ranks.size() == 3);

  kill(ranks[1], SIGKILL);
  const auto killed = std::chrono::steady_clock::now();
  CHECK(program.exit_code() != 0);

  const auto all_gone = [&] { return std::none_of(ranks.begin(), ranks.end(), is_running); };
  while (!all_gone() && std::chrono::steady_clock::now() - killed < std::chrono::seconds(10)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(all_gone());
  CHECK(tamp_with(restart_of(run, "--steps 150")).exit_code == 0);
  CHECK(summary_of(run)["state_digest"] == straight().digest);
}

}  // namespace test_restart
