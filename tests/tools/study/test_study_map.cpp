#include "tools/study/study_map.hpp"

#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace test_study_map
{

using namespace tamp::tools;
using namespace tamp::tools::study;
using tamp::test::TemporaryFolder;

namespace
{

/// Two methods of which one has a sweep of two settings, and the other adds a row.
Study study_with_map()
{
  Study study;
  study.quantities = {{"depth", Take::last, "depth[m]"}};
  study.methods = {{"all", "all", false, {}, {{"/a", {"x", "y"}}, {"/b", {1, 2}}}, {}},
                   {"more", "more", false, {{"/a", "z"}}, {{"/b", {2}}}, {}},
                   {"other", "other", false, {{"/a", "x"}, {"/b", 1}}, {}, {}}};
  study.map = StudyMap{"depth", 0.1, 1, {{"sheet", {"all", "more"}, "/a", "/b", 1.5}}};
  return study;
}

MeasuredPoint measured(const Point& point, End end)
{
  return {point, {end, end == End::done ? "" : "step 3: lost", {}, 0, {}}};
}

constexpr const char* small_study = R"({
  "measure": { "run": "flight.json" },
  "methods": [{ "name": "all", "sweep": { "/transfer": ["flip", "pic"], "/grid/cell_size": [0.2, 0.1] } }],
  "quantities": [{ "name": "depth", "column": "block.depth[m]", "take": "greatest", "exact": 0.1 }],
  "map": { "quantity": "depth", "noisy": 0.1, "blown": 1, "sheets": [SHEET] },
  "repeat": 1
})";

constexpr const char* flight = R"({
  "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.1 }, "time": { "end": 1e-3 },
  "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e9, "shear_modulus": 7e8 } },
  "bodies": { "block": { "material": "steel", "velocity": [0, -100],
                         "geometry": { "type": "box", "lower": [0.4, 0.6], "upper": [0.6, 0.8] } } },
  "output": { "history_interval": 1e-4, "fields_interval": 1e-3 }
})";

tamp::test::Outcome run(const TemporaryFolder& folder, const std::string& sheet)
{
  folder.write("flight.json", flight);
  std::string text = small_study;
  text.replace(text.find("SHEET"), 5, sheet);
  const auto file = folder.write("study.json", text);
  return tamp::test::tamp_with("study " + file.string() + " --out " + (folder.path() / "out").string());
}

}  // namespace

TEST_CASE("a map has a cell for each point of its methods, by the distance that decides")
{
  const Study study = study_with_map();
  std::vector<MeasuredPoint> points;
  for (const Point& point : points_of(study)) points.push_back(measured(point, End::done));
  points[2].result.end = End::unstable;
  points[3].result.end = End::refused;
  Findings findings;
  findings.quantities.resize(1);
  findings.quantities[0].errors = {{1, 0.05}, {2, 0.1}, {5, 1.0}, {6, 0.0}};

  const std::vector<MapOfSheet> map = map_of(study, points, findings);

  REQUIRE(map.size() == 1);
  CHECK(map[0].rows == std::vector<Json>{"x", "y", "z"});
  CHECK(map[0].columns == std::vector<Json>{1, 2});
  REQUIRE(map[0].cells.size() == 5);
  const std::vector<MapVerdict> expected{MapVerdict::stable, MapVerdict::noisy, MapVerdict::blown, MapVerdict::refused,
                                         MapVerdict::blown};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(map[0].cells[i].point == static_cast<int>(i) + 1);
    CHECK(map[0].cells[i].verdict == expected[i]);
  }
  CHECK(map[0].cells[4].row == 2);
  CHECK(map[0].cells[4].column == 1);
  CHECK_FALSE(map[0].cells[2].distance);
}

TEST_CASE("a run that is done without a finite answer is blown")
{
  const Study study = study_with_map();
  std::vector<MeasuredPoint> points;
  for (const Point& point : points_of(study)) points.push_back(measured(point, End::done));
  Findings findings;
  findings.quantities.resize(1);

  CHECK(map_of(study, points, findings)[0].cells[0].verdict == MapVerdict::blown);
}

TEST_CASE("a study with a map writes it with the command of each run", "[slow]")
{
  const TemporaryFolder folder;

  const auto outcome =
      run(folder, R"({"name": "transfer", "methods": ["all"], "rows": "/transfer", "columns": "/grid/cell_size"})");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Catch::Contains("transfer: 4 runs: 4 stable, 0 noisy, 0 blown, 0 refused"));
  const std::string table = tamp::test::read_text(folder.path() / "out/map.csv");
  CHECK_THAT(table, Catch::StartsWith("sheet,rows,row,columns,column,is,distance,reason,command\n"));
  CHECK_THAT(table, Catch::Contains("transfer,/transfer,pic,/grid/cell_size,0.1,stable,"));
  CHECK_THAT(table, Catch::Contains("--set /grid/cell_size=0.1"));
  CHECK(std::filesystem::exists(folder.path() / "out/charts/depth-map-1.png"));
}

TEST_CASE("a map of what a study has not is refused with its place")
{
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& sheet, const std::string& says) {
    const auto outcome = run(folder, sheet);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Catch::Contains(says));
  };

  refused(R"({"name": "a", "methods": ["some"], "rows": "/transfer", "columns": "/grid/cell_size"})",
          "#/map/sheets/0/methods: \"some\"; expected names of methods");
  refused(R"({"name": "a", "methods": ["all"], "rows": "/interpolator", "columns": "/grid/cell_size"})",
          "#/map/sheets/0/rows: /interpolator; expected what its methods set");
  refused(R"({"name": "a", "methods": ["all"], "rows": "/transfer", "columns": "grid"})",
          "#/map/sheets/0/columns: \"grid\"; expected a JSON pointer");
}

}  // namespace test_study_map
