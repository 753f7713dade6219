#include <hdf5.h>
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/tools/background_program.hpp"
#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/files/input_file.hpp"

namespace test_study_command
{

using namespace tamp::test;
using Catch::Contains;
using Json = nlohmann::json;

namespace
{

/// A block of steel that flies through an empty box, and a study of it: its depth needs no grid to be exact.
class FlightStudy
{
 public:
  FlightStudy()
  {
    draw_no_pages();
    folder_.write("flight.json", R"({
      "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.1 }, "time": { "end": 1e-3 },
      "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e9, "shear_modulus": 7e8 } },
      "bodies": { "block": { "material": "steel", "velocity": [0, -100],
                             "geometry": { "type": "box", "lower": [0.4, 0.6], "upper": [0.6, 0.8] } } },
      "output": { "history_interval": 1e-4, "fields_interval": 1e-3 }
    })");
  }

  /// `tamp study` of the study with a patch laid over it.
  Outcome run(const std::string& patch = "{}", const std::string& options = "") const
  {
    return tamp_with(arguments(patch) + options);
  }

  std::string arguments(const std::string& patch) const
  {
    Json study = Json::parse(R"({
      "measure": { "run": "flight.json" },
      "methods": [{ "name": "flight" }],
      "sweep": { "/grid/cell_size": [0.2, 0.1, 0.05] },
      "quantities": [{ "name": "depth", "column": "block.depth[m]", "take": "greatest", "exact": 0.1 }],
      "repeat": 1
    })");
    study.merge_patch(Json::parse(patch));
    folder_.write("study.json", study.dump());
    return "study " + (path() / "study.json").string() + " --quiet --out " + out().string() + " ";
  }

  Json results() const { return Json::parse(read_text(out() / "study.json")); }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path out() const { return path() / "out"; }
  /// The folder of the kept point that is first by name.
  std::filesystem::path kept_point() const
  {
    std::filesystem::path first;
    for (const auto& entry : std::filesystem::directory_iterator(out() / "points")) {
      if (entry.is_directory() && (first.empty() || entry.path() < first)) first = entry.path();
    }
    return first;
  }
  std::size_t n_kept() const
  {
    std::size_t n = 0;
    if (!std::filesystem::exists(out() / "points")) return n;
    for (const auto& entry : std::filesystem::directory_iterator(out() / "points")) {
      n += std::filesystem::exists(entry.path() / "result.json") ? 1 : 0;
    }
    return n;
  }

 private:
  TemporaryFolder folder_;
};

using Damage = void (*)(const std::filesystem::path&);

void emptied(const std::filesystem::path& file)
{
  std::filesystem::resize_file(file, 0);
}
void half(const std::filesystem::path& file)
{
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
}
void removed(const std::filesystem::path& file)
{
  std::filesystem::remove(file);
}
void a_pipe_at(const std::filesystem::path& file)
{
  REQUIRE(mkfifo(file.c_str(), 0600) == 0);
}
void a_pipe(const std::filesystem::path& file)
{
  removed(file);
  a_pipe_at(file);
}
/// The file stays as long as it is.
void in_the_last_digit(const std::filesystem::path& file)
{
  std::string text = read_text(file);
  char& digit = text[text.find_last_of("0123456789")];
  digit = digit == '9' ? '0' : '9';
  std::ofstream(file) << text;
}
void without_outputs(const std::filesystem::path& file)
{
  removed(file);
  H5Fclose(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
}
void cheaper(const std::filesystem::path& file)
{
  Json result = Json::parse(read_text(file));
  result["costs"][0]["core_s"] = 1e-9;
  std::ofstream(file) << result;
}
/// As no program wrote it, with a checksum that holds.
void without_files(const std::filesystem::path& file)
{
  nlohmann::ordered_json result{{"key", file.parent_path().filename().string()}};
  result["checksum"] = tamp::tools::hash_of(result.dump());
  std::ofstream(file) << result;
}
void a_list(const std::filesystem::path& file)
{
  std::ofstream(file) << "[]";
}

}  // namespace

TEST_CASE("a rehearsal runs every point for a few steps, fails for no reference, and is not taken for a whole result",
          "[slow]")
{
  const FlightStudy study;
  const std::string with_reference = R"({
    "reference": { "set": { "/time/minimum_step": 1 } },
    "quantities": [{ "name": "depth", "column": "block.depth[m]", "take": "greatest" }]
  })";

  const Outcome rehearsal = study.run(with_reference, "--steps 2"), whole = study.run("{}");

  CHECK(rehearsal.exit_code == 0);
  CHECK(whole.exit_code == 0);
  CHECK(study.n_kept() == 7);
  const Json results = study.results();
  for (const Json& point : results["points"]) CHECK(point["cost"]["steps"].get<double>() > 2);
  CHECK(study.run("{}", "--steps 0").exit_code == 2);
}

TEST_CASE("a study measures its points, and their errors against the exact answer", "[slow]")
{
  const FlightStudy study;

  const Outcome outcome = study.run(R"({"repeat": 2})");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json points = study.results()["points"];
  REQUIRE(points.size() == 3);
  for (const Json& point : points) {
    CHECK(point["ended"] == "done");
    CHECK(point["values"]["depth"].get<double>() == Approx(0.1).epsilon(1e-9));
    CHECK(point["errors"]["depth"].get<double>() < 1e-9);
    CHECK(point["cost"]["core_s_low"].get<double>() <= point["cost"]["core_s_high"].get<double>());
  }
  CHECK_THAT(points[0]["command"].get<std::string>(), Contains("--set /grid/cell_size=0.2"));
  CHECK_THAT(read_text(study.out() / "points.csv"), Contains("id,method,/grid/cell_size,ended,reason,core_s"));
}

TEST_CASE("numbers are taken of the particles' fields")
{
  const FlightStudy study;

  const Outcome outcome = study.run(R"({
    "sweep": null, "refine": null,
    "quantities": [
      {"name": "lowest", "take": "quantile", "quantile": 0, "field": "position", "component": 1, "material": "steel"},
      {"name": "density", "take": "field_rms", "field": "density", "material": "steel", "line": [8000, 0, 100]}]
  })");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json values = study.results()["points"][0]["values"];
  // Rows of particles have come from 0.625, 0.675, 0.725 and 0.775 m, 0.1 m down.
  CHECK(values["lowest"].get<double>() == Approx(0.525));
  const double mean_square = (0.525 * 0.525 + 0.575 * 0.575 + 0.625 * 0.625 + 0.675 * 0.675) / 4;
  CHECK(values["density"].get<double>() == Approx(100 * std::sqrt(mean_square)));
}

TEST_CASE("what was expected is judged, told and written, and a study that misses it is done", "[slow]")
{
  const FlightStudy study;
  draw_pages();
  const std::string patch = R"({"expect": [
    {"quantity": "depth", "error_at_most": 1e-9, "why": "nothing acts on it"},
    {"quantity": "depth", "methods": ["flight"], "error_at_least": 0.5}], "refine": "/grid/cell_size"})";

  const Outcome outcome = study.run(patch);

  REQUIRE(outcome.exit_code == 0);
  const Json gates = study.results()["gates"];
  REQUIRE(gates.size() == 2);
  CHECK(gates[0]["holds"] == true);
  CHECK(gates[1]["holds"] == false);
  CHECK(gates[1]["expected"] == "error at least 50 %");
  CHECK_THAT(read_text(study.out() / "gates.csv"), Contains("depth,flight,error_at_least,0.5"));
  CHECK_THAT(read_text(study.out() / "index.html"), Contains("1 of 2 do not hold"));
}

TEST_CASE("points of a study with an old word are those with the new one, and the word is noted once", "[slow]")
{
  const FlightStudy study;
  const auto with = [](const std::string& transfer) {
    return R"({"methods": [{"name": "flight", "set": {"/transfer": ")" + transfer + R"("}}]})";
  };
  REQUIRE(study.run(with("tflip")).err.empty());
  const auto since = std::filesystem::file_time_type::clock::now();

  const Outcome outcome = study.run(with("affine"));

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err ==
        "tamp: note: " + (study.path() / "study.json").string() + "#/transfer: \"affine\" is now \"tflip\"\n");
  for (const auto& entry : std::filesystem::directory_iterator(study.out() / "points")) {
    CHECK(std::filesystem::last_write_time(entry.path()) < since);
  }
}

TEST_CASE("a study that has all its results runs nothing, and writes the same again", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  const std::string table = read_text(study.out() / "points.csv"), json = read_text(study.out() / "study.json");
  const auto since = std::filesystem::file_time_type::clock::now();

  REQUIRE(study.run().exit_code == 0);

  CHECK(read_text(study.out() / "points.csv") == table);
  CHECK(read_text(study.out() / "study.json") == json);
  for (const auto& entry : std::filesystem::directory_iterator(study.out() / "points")) {
    CHECK(std::filesystem::last_write_time(entry.path()) < since);
  }
}

TEST_CASE("what a file holds decides whether a result is still one", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  std::string scene = read_text(study.path() / "flight.json");
  scene.replace(scene.find("-100"), 4, "-50");
  std::ofstream(study.path() / "flight.json") << scene;

  REQUIRE(study.run().exit_code == 0);

  CHECK(study.results()["points"][0]["values"]["depth"].get<double>() == Approx(0.05).epsilon(1e-9));
}

TEST_CASE("points that become unstable, take too long or are refused are there with their reasons", "[slow]")
{
  const FlightStudy study;

  const Outcome outcome = study.run(R"({
    "limit_s": 1, "sweep": null,
    "points": [{ "method": "flight", "set": { "/grid/cell_size": 0.1 } },
               { "method": "flight", "set": { "/time/minimum_step": 1 } },
               { "method": "flight", "set": { "/time/end": 1e3, "/output/history_interval": 1, "/output/fields_interval": 100, "/limits/energy_error": "off" } },
               { "method": "flight", "set": { "/grid/cell_size": 0.3 } }]
  })");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json points = study.results()["points"];
  CHECK(points[0]["ended"] == "done");
  CHECK(points[1]["ended"] == "unstable");
  CHECK_THAT(points[1]["reason"].get<std::string>(), Contains("step"));
  CHECK(points[2]["ended"] == "limit");
  CHECK_THAT(points[2]["reason"].get<std::string>(), Contains("not done after"));
  CHECK(points[3]["ended"] == "refused");
  CHECK_THAT(points[3]["reason"].get<std::string>(), Contains("#/grid"));
  CHECK_FALSE(points[1]["errors"].contains("depth"));
}

TEST_CASE("a study in which no point ran ends with 2, and says why on stderr, each reason once")
{
  const FlightStudy study;

  const Outcome outcome = study.run(R"({"sweep": {"/grid/cell_size": [0.3, 0.7], "/time/end": [1e-3, 2e-3]}})");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("study.json: no point ran; expected settings that can be run"));
  const Json results = study.results();
  for (const Json& point : results["points"]) {
    const std::string reason = point["reason"];
    CAPTURE(reason);
    CHECK(point["ended"] == "refused");
    CHECK_THAT(outcome.err, Contains(reason));
    CHECK(outcome.err.find(reason) == outcome.err.rfind(reason));
  }
}

TEST_CASE("points far slower than the fastest end at its limit, and stay ended", "[slow]")
{
  const FlightStudy study;
  const std::string patch = R"({
    "limit_times_fastest": 20, "sweep": null,
    "points": [{ "method": "flight", "set": { "/grid/cell_size": 0.1 } },
               { "method": "flight", "set": { "/time/end": 1e3, "/output/history_interval": 1,
                                              "/output/fields_interval": 100, "/limits/energy_error": "off" } }]
  })";
  REQUIRE(study.run(patch).exit_code == 0);
  const std::string first = read_text(study.out() / "study.json");

  REQUIRE(study.run(patch).exit_code == 0);

  CHECK(study.results()["points"][1]["ended"] == "limit");
  CHECK(read_text(study.out() / "study.json") == first);
}

TEST_CASE("a study runs within a limit of processor time that it was started with")
{
  const FlightStudy study;
  const std::string arguments = study.arguments(R"({"sweep": null, "limit_s": 1000})");

  const Outcome outcome = outcome_of("ulimit -t 500; " TAMP_PROGRAM " " + arguments);

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(study.results()["points"][0]["ended"] == "done");
}

TEST_CASE("a slow point that was done stays done however its later timings end", "[slow]")
{
  const FlightStudy study;
  const std::string patch = R"({
    "limit_times_fastest": 20, "sweep": null, "repeat": 2,
    "points": [{ "method": "flight", "set": { "/grid/cell_size": 0.005, "/time/end": 2e-3 } },
               { "method": "flight", "set": { "/grid/cell_size": 0.2 } }]
  })";
  REQUIRE(study.run(patch).exit_code == 0);

  for (const auto& entry : std::filesystem::directory_iterator(study.out() / "points")) {
    if (!std::filesystem::is_directory(entry)) continue;
    CHECK(Json::parse(read_text(entry.path() / "result.json"))["ended"] == "done");
    CHECK(Json::parse(read_text(entry.path() / "summary.json"))["status"] != "interrupted");
  }
}

TEST_CASE("a run that somebody kills is no result")
{
  const FlightStudy study;
  BackgroundProgram program(TAMP_PROGRAM,
                            study.arguments(R"({"sweep": null, "set": {"/time/end": 1e3, "/limits/energy_error": "off",
                              "/output/history_interval": 1, "/output/fields_interval": 100}})"));
  wait_until([&] { return !program.children().empty(); });

  kill(program.children().front(), SIGKILL);

  CHECK(program.exit_code() == 4);
  CHECK(study.n_kept() == 0);
}

TEST_CASE("a kept point whose files are not what was written is run again, and told of once", "[slow]")
{
  const FlightStudy study;
  // Its points are one, so that one is reported.
  const std::string patch = R"({"methods": [{"name": "a"}, {"name": "b"}], "sweep": null, "quantities": [
    {"name": "depth", "column": "block.depth[m]", "take": "greatest", "exact": 0.1},
    {"name": "lowest", "take": "quantile", "quantile": 0, "field": "position", "component": 1, "material": "steel"}]})";
  REQUIRE(study.run(patch).exit_code == 0);
  const Json before = study.results()["points"][0]["values"];
  const auto [name, damage, said] = GENERATE(table<std::string, Damage, std::string>({
      {"history.csv", in_the_last_digit, "is not what was written"},
      {"history.csv", half, "is not what was written"},
      {"history.csv", removed, "is missing"},
      {"fields.h5", without_outputs, "is not what was written"},
      {"fields.h5", half, "is not what was written"},
      {"fields.h5", a_pipe, "is no file"},
      {"summary.json", emptied, "is not what was written"},
      {"result.json", emptied, "parse error"},
      {"result.json", half, "parse error"},
      {"result.json", removed, "no such file"},
      {"result.json", a_pipe, "a pipe"},
      {"result.json", cheaper, "is not what its checksum says"},
      {"result.json", without_files, "is no result"},
      {"result.json", a_list, "has no checksum"},
  }));
  damage(study.kept_point() / name);

  const Outcome outcome = study.run(patch);

  INFO(name << ": " << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(study.results()["points"][0]["values"] == before);
  const std::string place = "tamp: warning: a: " + (study.kept_point() / name).string();
  CHECK_THAT(outcome.err, Contains(place) && Contains(said) && Contains("it is run again"));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(study.run(patch).err.empty());
}

TEST_CASE("what stands in the way of kept points goes", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  std::filesystem::remove_all(study.out() / "points");
  std::filesystem::create_directory(study.out() / "points");
  a_pipe_at(study.out() / "points/errors.txt");
  REQUIRE(study.run().exit_code == 0);
  std::filesystem::remove_all(study.out() / "points");
  a_pipe_at(study.out() / "points");

  CHECK(study.run().exit_code == 0);
  CHECK(study.n_kept() == 3);
}

TEST_CASE("a kept point under another one's name is run again", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  const std::string table = read_text(study.out() / "points.csv");
  const auto first = study.kept_point(), aside = study.path() / "aside";
  std::filesystem::rename(first, aside);
  std::filesystem::copy(study.kept_point(), first);

  const Outcome outcome = study.run();

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("result.json: is of another point: it is run again"));
  CHECK(Json::parse(read_text(first / "summary.json"))["steps"] ==
        Json::parse(read_text(aside / "summary.json"))["steps"]);
}

TEST_CASE("a study that is killed goes on where it was", "[slow]")
{
  const FlightStudy study;
  const std::string patch = R"({"sweep": {"/grid/cell_size": [0.2, 0.1, 0.05, 0.04, 0.025, 0.02, 0.0125]}})";
  {
    const BackgroundProgram program(TAMP_PROGRAM, study.arguments(patch));
    wait_until([&] { return study.n_kept() >= 2; });
  }  // killed
  const std::size_t n_before = study.n_kept();
  const auto since = std::filesystem::file_time_type::clock::now();

  REQUIRE(study.run(patch).exit_code == 0);

  CHECK(n_before < 7);
  CHECK(study.n_kept() == 7);
  std::size_t n_older = 0;
  for (const auto& entry : std::filesystem::directory_iterator(study.out() / "points")) {
    if (!std::filesystem::is_directory(entry)) continue;
    n_older += std::filesystem::last_write_time(entry.path() / "result.json") < since ? 1 : 0;
  }
  CHECK(n_older == n_before);
}

TEST_CASE("a study that is asked to stop ends the run under way, and says so")
{
  const FlightStudy study;
  BackgroundProgram program(
      TAMP_PROGRAM,
      study.arguments(
          R"({"sweep": null, "set": {"/time/end": 1e3, "/output/history_interval": 1, "/output/fields_interval": 100}})"));
  wait_until([&] { return !program.children().empty(); });
  const pid_t child = program.children().front();

  program.send(SIGTERM);

  CHECK(program.exit_code() == 128 + SIGTERM);
  CHECK_FALSE(is_running(child));
}

TEST_CASE("results of another program are refused, and removed only when asked", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  std::ofstream(study.out() / ".tamp-study") << R"({"program": "another", "version": "0.0.9"})";

  const Outcome refused = study.run();
  const std::size_t n_kept = study.n_kept();
  std::ofstream(study.out() / "points" / "old") << "another program's";
  const Outcome forced = study.run("{}", "--force");

  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err,
             Contains("results of another program or processor") && Contains("0.0.9") && Contains("--force"));
  CHECK(n_kept == 3);
  CHECK(forced.exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(study.out() / "points" / "old"));
}

TEST_CASE("paths that are no UTF-8 are reported in JSON with a mark, and are no settings", "[slow]")
{
  const FlightStudy study;
  const std::string odd = (study.path() / "odd\xff").string(), file = odd + "/st\xfe.json";
  study.arguments(R"({"sweep": null})");
  std::filesystem::create_directory(odd);
  std::filesystem::copy(study.path() / "flight.json", odd + "/flight.json");
  std::filesystem::copy(study.path() / "study.json", file);

  const Outcome run = tamp_with("run " + odd + "/flight.json --quiet --steps 1 --out " + odd + "/run\xfe");
  const Outcome swept = tamp_with("study " + file + " --quiet --out " + odd + "/out");
  study.arguments(R"({"sweep": null, "set": {"/title": "flight.json"}})");
  std::filesystem::copy(study.path() / "study.json", odd + "/set.json");
  const Outcome set = tamp_with("study " + odd + "/set.json --quiet --out " + odd + "/none");

  CHECK(run.err.empty());
  CHECK(run.exit_code == 0);
  CHECK(swept.err.empty());
  CHECK(swept.exit_code == 0);
  CHECK(Json::parse(read_text(odd + "/out/study.json"))["name"] == "st\xef\xbf\xbd");
  CHECK(set.exit_code == 2);
  CHECK_THAT(set.err, Contains("expected a path that is UTF-8"));
}

TEST_CASE("a mark that says nothing, or something else, is another program's", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  const std::string content = GENERATE("", "\n", "{", "\xff", "[]", "null");
  std::ofstream(study.out() / ".tamp-study") << content;

  const Outcome refused = study.run();
  const Outcome forced = study.run("{}", "--force");

  INFO(content << ": " << refused.err);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Contains("results of another program or processor: ") && Contains("--force"));
  CHECK(forced.exit_code == 0);
  CHECK(study.run().exit_code == 0);
}

TEST_CASE("a folder that is no study's is left alone")
{
  const FlightStudy study;
  std::filesystem::create_directories(study.out());
  std::ofstream(study.out() / "letter.txt") << "dear";
  CHECK(study.run("{}", "--force").exit_code == 2);
  CHECK(read_text(study.out() / "letter.txt") == "dear");
}

TEST_CASE("results that cannot be written are refused before anything runs")
{
  const FlightStudy study;
  std::filesystem::create_directories(study.out());
  const std::ofstream mark(study.out() / ".tamp-study");
  const auto name = GENERATE("points.csv", "study.json", "gates.csv");
  std::filesystem::create_directory(study.out() / name);

  const Outcome outcome = study.run("{}", "--force");

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Contains(std::string(name) + ": Is a directory"));
  CHECK(study.n_kept() == 0);
}

TEST_CASE("a pointer to nothing ends a study before anything runs", "[slow]")
{
  const FlightStudy study;
  const Outcome misspelt = study.run(R"({"sweep": {"/grid/cel_size": [0.1]}})");
  const Outcome nowhere = study.run(R"({"set": {"/materials/sand/tolerance": 1}})");
  const Outcome beyond = study.run(R"({"set": {"/grid/upper/3000000": 1}})");
  const Outcome endless = study.run(R"({"set": {"/grid/upper/99999999999999999999": 1}})");
  const Outcome refined = study.run(R"({"refine": "/grid/cells"})");

  CHECK(misspelt.exit_code == 2);
  CHECK_THAT(misspelt.err, Contains("study.json#/grid/cel_size: unknown key; did you mean \"cell_size\"?"));
  CHECK(nowhere.exit_code == 2);
  CHECK_THAT(nowhere.err, Contains("/materials/sand/tolerance: there is no such place"));
  CHECK(beyond.exit_code == 2);
  CHECK(endless.exit_code == 2);
  CHECK_THAT(endless.err, Contains("/grid/upper/99999999999999999999: there is no such place"));
  CHECK(refined.exit_code == 2);
  CHECK_THAT(refined.err, Contains("study.json#/refine: /grid/cells, which no point sets"));
  CHECK(study.n_kept() == 0);
}

TEST_CASE("a column that the runs do not have ends a study after the first of them")
{
  const FlightStudy study;
  const Outcome outcome = study.run(R"({"quantities": [{"name": "q", "column": "sand.q_max[Pa]"}]})");
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("there is no column \"sand.q_max[Pa]\"") && Contains("block.depth[m]"));
}

TEST_CASE("a reference that fails ends a study with 3, after all it has found is written", "[slow]")
{
  const FlightStudy study;
  const Outcome outcome = study.run(R"({
    "quantities": [{"name": "depth", "column": "block.depth[m]", "take": "greatest"}],
    "reference": {"set": {"/time/minimum_step": 1}}
  })");

  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.err, Contains("the reference") && Contains("unstable"));
  CHECK(study.results()["points"].size() == 4);
  CHECK_THAT(study.results()["quantities"][0]["reference"]["note"].get<std::string>(), Contains("no reference"));
}

TEST_CASE("a reference that would be refused ends a study before anything runs")
{
  const FlightStudy study;
  const Outcome outcome = study.run(R"({
    "quantities": [{"name": "depth", "column": "block.depth[m]", "take": "greatest"}],
    "reference": {"refine": "/grid/cell_size", "values": [0.2, 0.1, 0.03]}
  })");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("study.json#/reference") && Contains("cell"));
  CHECK(study.n_kept() == 0);
}

TEST_CASE("a result that is a link to what the study reads, or to another result, is refused, and both stay", "[slow]")
{
  const FlightStudy study;
  draw_pages();
  REQUIRE(study.run().exit_code == 0);
  const auto [name, target] = GENERATE(table<std::string, std::string>(
      {{"points.csv", "../flight.json"}, {"study.json", "../study.json"}, {"index.html", "study.json"}}));
  const std::filesystem::path link = study.out() / name;
  std::filesystem::remove(link);
  std::filesystem::create_symlink(target, link);
  const std::string before = read_text(link);

  const Outcome outcome = study.run();

  INFO(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains(name) && Contains("expected another file"));
  CHECK(read_text(link) == before);
}

TEST_CASE("a pipe in the place of a result of a study is refused before anything runs", "[slow]")
{
  const FlightStudy study;
  REQUIRE(study.run().exit_code == 0);
  a_pipe(study.out() / "points.csv");

  const Outcome outcome = outcome_of("timeout --signal=KILL 60 " TAMP_PROGRAM " " + study.arguments("{}"));

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Contains("points.csv: a pipe, a device or a socket; expected a file"));
}

}  // namespace test_study_command
