#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/program.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_studies
{

/// The shipped studies in their short forms, run through to the page.
using namespace tamp::test;
using Json = nlohmann::json;

namespace
{

struct ShortStudy {
  Json results;
  std::string page;

  /// The methods with a point that ended in this way.
  std::set<std::string> methods(const std::string& end) const
  {
    std::set<std::string> names;
    for (const Json& point : results["points"]) {
      if (point["ended"] == end) names.insert(point["method"]);
    }
    return names;
  }

  double error(const std::string& method, const std::string& quantity, const Json& refine = nullptr) const
  {
    for (const Json& point : results["points"]) {
      if (point["method"] == method && (refine.is_null() || point["refine"] == refine)) {
        return point["errors"].at(quantity);
      }
    }
    FAIL("no point of " << method);
    return 0;
  }

  double value(const std::string& method, const std::string& quantity, const Json& refine) const
  {
    for (const Json& point : results["points"]) {
      if (point["method"] == method && point["refine"] == refine) return point["values"].at(quantity);
    }
    FAIL("no point of " << method);
    return 0;
  }

  double order(const std::string& method) const
  {
    for (const Json& fit : results["quantities"][0]["orders"]) {
      if (fit["method"] == method) return fit["order"];
    }
    FAIL("no order of " << method);
    return 0;
  }
};

std::size_t n_points_shown(const std::string& page)
{
  const std::string one = "<template id=\"point-";
  std::size_t n = 0;
  for (std::size_t at = page.find(one); at != std::string::npos; at = page.find(one, at + 1)) ++n;
  return n;
}

ShortStudy run_short(const std::string& name)
{
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  const Outcome outcome = tamp_with("study " TAMP_SOURCE_DIR "/inputs/studies/" + name +
                                    ".json --short --quiet --out " + out.string() + rehearsed);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  ShortStudy study{Json::parse(read_text(out / "study.json")), read_text(out / "index.html")};
  CHECK(n_points_shown(study.page) == study.results["points"].size());
  CHECK(std::filesystem::exists(out / "points.csv"));
  return study;
}

}  // namespace

TEST_CASE("the short study of moduli finds the network nearer to the measurements than the regression", "[slow]")
{
  const ShortStudy study = run_short("moduli");
  if (is_rehearsal) return;
  CHECK(study.error("MLP", "K, root mean square") < study.error("SVR", "K, root mean square") / 5);
  CHECK(study.error("Table", "K, root mean square") < 0.01);
}

TEST_CASE("the short studies of the return mapping have smaller errors for smaller tolerances", "[slow]")
{
  const std::string name = GENERATE("return_mapping", "return_mapping_large_increments");
  const ShortStudy study = run_short(name);
  if (is_rehearsal) return;

  CHECK(study.methods("done").size() > 1);
  for (const Json& coarse : study.results["points"]) {
    for (const Json& fine : study.results["points"]) {
      const bool are_of_one = coarse["method"] == fine["method"] && fine["method"] != "reference";
      if (!are_of_one || coarse["refine"].get<double>() < 99 * fine["refine"].get<double>()) continue;
      INFO(coarse["label"] << " beside " << fine["label"]);
      CHECK(fine["errors"]["p"].get<double>() < coarse["errors"]["p"].get<double>());
    }
  }
}

TEST_CASE("the short maps of where methods fail have a stable cell for each of their runs", "[slow]")
{
  const std::string name = GENERATE("map_bar", "map_vortex", "map_piston", "map_block", "map_punch");
  const ShortStudy study = run_short(name);
  if (is_rehearsal) return;

  const Json sheets = study.results["map"]["sheets"];
  REQUIRE(sheets.size() == 1);
  REQUIRE(sheets[0]["cells"].size() == 4);
  for (const Json& cell : sheets[0]["cells"]) {
    INFO(name << " " << cell);
    CHECK(cell["verdict"] == "stable");
  }
}

TEST_CASE("the short study of the bar finds second order, and the published bound without its factor unstable",
          "[slow]")
{
  const ShortStudy study = run_short("bar");
  if (is_rehearsal) return;
  CHECK(study.order("GIMP, flip") == Approx(2).margin(0.15));
  CHECK(study.order("splines, tflip") == Approx(2).margin(0.15));
  CHECK(study.methods("unstable") == std::set<std::string>{"published bound, 1"});
}

TEST_CASE("the short study of the report's settings runs a slab one cell thick, with 8 particles a cell", "[slow]")
{
  const ShortStudy study = run_short("cost");
  const Json& point = study.results["points"][0];

  // Sand of 1 m x 0.5 m and a punch of 0.3 m x 0.2 m, in cells of 4 cm.
  const double n_cells = (1 * 0.5 + 0.3 * 0.2) / (0.04 * 0.04);
  CHECK(point["method"] == "report's settings");
  CHECK(point["cost"]["particle_steps"].get<double>() / point["cost"]["steps"].get<double>() == Approx(8 * n_cells));
}

TEST_CASE("the short study of the punch has an error budget", "[slow]")
{
  const ShortStudy study = run_short("punch");
  if (is_rehearsal) return;

  CHECK(study.methods("done").contains("as shipped: q"));
  const Json& parts = study.results["budgets"][0]["parts"];
  REQUIRE(parts.size() > 5);
  for (const Json& part : parts) {
    INFO(part.dump());
    CHECK((part["amount"].is_null() || part["amount"].get<double>() < 0.1));
    CHECK(part["amount"].is_null() == (part["note"].get<std::string>().find("no bound") != std::string::npos));
  }
}

TEST_CASE("the short study of the punch on other grids compares each strength with its own limit", "[slow]")
{
  const ShortStudy study = run_short("punch_other_grids");
  if (is_rehearsal) return;

  CHECK(study.methods("done").contains("sqrt(J2)"));
  CHECK(study.error("as shipped: q", "depth at 0.2 ms") < 0.1);
}

TEST_CASE("the short study of viscosity finds the piston nearer to its exact force with 1 / 4 than with 0.2 / 2",
          "[slow]")
{
  const ShortStudy study = run_short("viscosity_piston_200");
  if (is_rehearsal) return;

  const double cell_size = 0.02;
  CHECK(study.error("cubic, flip, 1 / 4", "pressure", cell_size) <
        study.error("cubic, flip, 0.2 / 2", "pressure", cell_size));
}

TEST_CASE("the short studies of viscosity in other scenes run to their end", "[slow]")
{
  const ShortStudy study = run_short(GENERATE("viscosity_impact", "viscosity_punch", "viscosity_projectile"));
  if (is_rehearsal) return;

  CHECK(study.methods("done").size() > 1);
  CHECK(study.methods("unstable").empty());
}

TEST_CASE("the short study of the projectile has an error budget", "[slow]")
{
  const ShortStudy study = run_short("projectile");
  if (is_rehearsal) return;
  CHECK(study.methods("done").contains("regression"));
  CHECK(study.results["budgets"].size() == 2);
}

TEST_CASE("in the short study of localisation sand that rubs and widens stops the punch earlier than the same without",
          "[slow]")
{
  const ShortStudy study = run_short("localisation");
  if (is_rehearsal) return;

  CHECK(study.methods("done").size() == 5);  // four materials and the reference
  for (const double cell_size : {0.05, 0.025}) {
    CHECK(study.value("concrete sand", "depth", cell_size) <
          0.98 * study.value("concrete sand, strength of clay", "depth", cell_size));
  }
}

TEST_CASE("in the short study of rings FLIP keeps most of the energy, and PIC less than half", "[slow]")
{
  const ShortStudy study = run_short("rings");
  if (is_rehearsal) return;

  CHECK(study.error("flip", "energy left") < 0.2);
  CHECK(study.error("pic", "energy left") > 0.5);
  CHECK(study.error("xpic 5", "energy left") > study.error("flip", "energy left"));
}

TEST_CASE("the short study of what methods cost has the sand stop the punch about alike with every method", "[slow]")
{
  const ShortStudy study = run_short("method_cost");
  if (is_rehearsal) return;

  CHECK(study.methods("done").size() == 22);
  const double lost = 200 + study.value("gimp", "velocity", nullptr);
  CHECK(lost > 10);
  for (const Json& point : study.results["points"]) {
    INFO(point["method"]);
    // Lost of the 200 m/s at the start; a sand of no weight takes 0.8.
    CHECK(200 + point["values"]["velocity"].get<double>() == Approx(lost).epsilon(0.5));
  }
}

}  // namespace test_studies
