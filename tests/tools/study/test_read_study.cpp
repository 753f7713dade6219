#include <catch2/catch.hpp>

#include "tests/tools/problems.hpp"
#include "tools/study/study.hpp"

namespace test_read_study
{

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;
using tools::Json;

namespace
{

/// The least that a study needs, with a patch laid over it.
Json study_with(const std::string& patch)
{
  Json study = Json::parse(R"({
    "measure": { "run": "scene.json" },
    "methods": [{ "name": "one" }],
    "quantities": [{ "name": "depth", "column": "punch.depth[m]", "take": "greatest" }]
  })");
  study.merge_patch(Json::parse(patch));
  return study;
}

std::string problems_of_study(const std::string& patch)
{
  const TemporaryFolder folder;
  folder.write("scene.json", "{}");
  const auto file = folder.write("study.json", study_with(patch).dump());
  return problems_of_reading(folder, [&] { tools::study::read_study(file, false); });
}

}  // namespace

TEST_CASE("the least study is sound")
{
  CHECK(problems_of_study("{}").empty());
}

TEST_CASE("a study that asks for nothing is refused")
{
  CHECK_THAT(problems_of_study(R"({"quantities": []})"), Contains("study.json#/quantities: no quantity"));
  CHECK_THAT(problems_of_study(R"({"quantities": null})"), Contains("study.json#/quantities"));
  CHECK_THAT(problems_of_study(R"({"methods": []})"), Contains("study.json#/methods: no method"));
  CHECK_THAT(problems_of_study(R"({"measure": {"run": null}})"), Contains("expected one of run, drive, modulus"));
  CHECK_THAT(problems_of_study(R"({"measure": {"run": "none.json"}})"), Contains("there is no file"));
}

TEST_CASE("an order takes three grids, from coarse to fine")
{
  const auto with_values = [](const std::string& values) {
    return problems_of_study(R"({"reference": {"refine": "/grid/cell_size", "values": )" + values + "}}");
  };
  CHECK(with_values("[4, 2, 1]").empty());
  CHECK_THAT(with_values("[4, 2]"), Contains("study.json#/reference/values: 2 values; expected 3 at least"));
  CHECK_THAT(with_values("[4, 2, 3]"), Contains("values that are no spacings"));
  CHECK_THAT(with_values("[4, 2, \"x\"]"), Contains("values that are no spacings"));
}

TEST_CASE("what is misspelt or of the wrong kind is reported with its place")
{
  CHECK_THAT(problems_of_study(R"({"metods": []})"), Contains("unknown key; did you mean \"methods\"?"));
  CHECK_THAT(problems_of_study(R"({"refine": "cell_size"})"), Contains("study.json#/refine: \"cell_size\""));
  CHECK_THAT(problems_of_study(R"({"sweep": {"/grid/cell_size": 4}})"), Contains("expected a list of values"));
  CHECK_THAT(problems_of_study(R"({"set": [1]})"), Contains("study.json#/set: array; expected an object"));
  CHECK_THAT(problems_of_study(R"({"points": [{"method": "two", "set": {}}]})"),
             Contains("study.json#/points/0/method: \"two\""));
  CHECK_THAT(problems_of_study(R"({"methods": [{"name": "a"}, {"name": "a"}]})"),
             Contains("study.json#/methods/1/name: \"a\", which is taken"));
  CHECK_THAT(problems_of_study(R"({"quantities": [{"name": "d", "column": "x", "take": "most"}]})"),
             Contains("study.json#/quantities/0/take"));
}

TEST_CASE("more points than a study can have are counted, not made")
{
  const auto with_axes = [](int n_axes, std::size_t n_values, const std::string& more = "") {
    Json patch{{"sweep", Json::object()}};
    for (int i = 0; i < n_axes; ++i) patch["sweep"]["/axis_" + std::to_string(i)] = std::vector<int>(n_values, i);
    patch.merge_patch(Json::parse(more.empty() ? "{}" : more));
    return problems_of_study(patch.dump());
  };
  CHECK(with_axes(4, 10).empty());
  CHECK_THAT(with_axes(8, 10), Contains("study.json#/sweep: 100000000 points; expected at most 10000"));
  CHECK_THAT(with_axes(64, 10), Contains("study.json#/sweep: over 1e15 points"));
  CHECK_THAT(with_axes(400, 10), Contains("study.json#/sweep: over 1e15 points"));
  CHECK_THAT(with_axes(4, 10, R"({"methods": [{"name": "a"}, {"name": "b"}]})"), Contains("#/sweep: 20000 points"));
  CHECK_THAT(with_axes(4, 10, R"({"methods": [{"name": "a", "sweep": {"/b": [1]}}, {"name": "b"}],
                                 "points": [{"method": "a", "set": {}}]})"),
             Contains("#/sweep: 10002 points"));
  CHECK_THAT(with_axes(4, 10, R"({"reference": {"set": {}}})"), Contains("#/sweep: 10001 points"));
}

TEST_CASE("columns and budgets need the reference that they are measured by")
{
  CHECK_THAT(problems_of_study(R"({"quantities": [{"name": "d", "column": "x", "take": "curve"}]})"),
             Contains("\"d\", a column, without a reference"));
  CHECK_THAT(problems_of_study(R"({"budget": {"quantities": ["depth"], "of": [{"name": "base"}],
                                              "parts": [{"name": "grid", "to_reference": true}]}})"),
             Contains("expected a study with a reference"));
  CHECK_THAT(problems_of_study(R"({"budget": {"quantities": ["speed"], "of": [{"name": "base"}], "parts": []}})"),
             Contains("\"speed\"; expected names of quantities"));
}

TEST_CASE("what is expected names quantities and methods that there are, and says one thing")
{
  const auto expecting = [](const std::string& expectation) {
    return problems_of_study(R"({"refine": "/h", "expect": [)" + expectation + "]}");
  };
  CHECK(expecting(R"({"quantity": "depth", "methods": ["one"], "order_at_least": 1.9, "why": "theory"})").empty());
  CHECK(expecting(R"({"quantity": "depth", "fails": true})").empty());
  CHECK_THAT(expecting(R"({"quantity": "speed", "fails": true})"),
             Contains("study.json#/expect/0/quantity: \"speed\""));
  CHECK_THAT(expecting(R"({"quantity": "depth", "methods": ["two"], "fails": true})"),
             Contains("study.json#/expect/0/methods: \"two\"; expected names of methods"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "methods": "one", "fails": true})"),
             Contains("study.json#/expect/0/methods: string; expected a list"));
  CHECK_THAT(expecting(R"({"quantity": "depth"})"), Contains("of which not one thing is to hold"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "fails": true, "error_at_most": 1})"),
             Contains("of which not one thing is to hold"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "fails": false})"), Contains("study.json#/expect/0/fails: false"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "error_at_most": -1})"),
             Contains("study.json#/expect/0/error_at_most"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "order_at_least": 2, "at": 1})"),
             Contains("study.json#/expect/0/at: given where no error of one of several grids is judged"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "error_at_most": 1, "limit_order": 1})"),
             Contains("study.json#/expect/0/limit_order: given where no limit is judged"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "limit_error_at_most": 1})"),
             Contains("study.json#/expect/0/limit_error_at_most: the limit of a quantity without an exact answer"));
  CHECK(expecting(R"({"quantity": "depth", "fails": true, "missed": {"one": "noise"}})").empty());
  CHECK_THAT(expecting(R"({"quantity": "depth", "fails": true, "missed": {"two": "noise"}})"),
             Contains("study.json#/expect/0/missed: \"two\"; expected methods of which it is expected"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "fails": true, "missed": {"one": ""}})"),
             Contains("study.json#/expect/0/missed: \"\" for \"one\"; expected why, in words"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "fails": true, "missed": ["one"]})"),
             Contains("study.json#/expect/0/missed: array; expected an object"));
  CHECK_THAT(expecting(R"({"quantity": "depth", "order": 2})"), Contains("study.json#/expect/0/order: unknown key"));
  CHECK_THAT(problems_of_study(R"({"expect": [{"quantity": "depth", "order_at_least": 2}]})"),
             Contains("study.json#/expect/0/order_at_least: an order in a study that refines nothing"));
}

TEST_CASE("an expectation without methods is for all")
{
  const TemporaryFolder folder;
  folder.write("scene.json", "{}");
  const auto file = folder.write("study.json", study_with(R"({"methods": [{"name": "one"}, {"name": "two"}],
      "expect": [{"quantity": "depth", "error_at_most": 0.1}]})")
                                                   .dump());

  CHECK(tools::study::read_study(file, false).expectations.at(0).methods == std::vector<std::string>{"one", "two"});
}

TEST_CASE("what is taken of fields and of the farthest value says all that it needs")
{
  CHECK_THAT(problems_of_study(R"({"quantities": [{"name": "d", "column": "x", "take": "farthest"}]})"),
             Contains("\"d\", the value farthest from no number"));
  const auto line = [](const std::string& numbers) {
    return problems_of_study(
        R"({"quantities": [{"name": "p", "take": "field_rms", "field": "p", "material": "m", "line": )" + numbers +
        "}]}");
  };
  CHECK(line("[1, 0, -2]").empty());
  CHECK_THAT(line("[1, 0]"), Contains("study.json#/quantities/0/line"));
  CHECK_THAT(line("[1, 0, \"z\"]"), Contains("study.json#/quantities/0/line"));
  CHECK_THAT(line("null"), Contains("study.json#/quantities/0/line: missing"));
  const auto component = [](const std::string& number) {
    return problems_of_study(R"({"quantities": [{"name": "x", "take": "quantile", "field": "position", "material": "m",
                                                 "component": )" +
                             number + "}]}");
  };
  CHECK(component("2").empty());
  CHECK_THAT(component("3"), Contains("study.json#/quantities/0/component"));
  CHECK_THAT(component("0.5"), Contains("study.json#/quantities/0/component"));
}

TEST_CASE("files among the settings are named from the study's folder")
{
  const TemporaryFolder folder;
  folder.write("scene.json", "{}");
  folder.write("sizes/small.json", "{}");
  const auto file = folder.write(
      "study.json", study_with(R"({"set": {"/modulus/svr": "sizes/small.json", "/title": "no.json"}})").dump());

  const tools::study::Study study = tools::study::read_study(file, false);

  CHECK(std::filesystem::equivalent(study.settings[0].second.get<std::string>(), folder.path() / "sizes/small.json"));
  CHECK(study.settings[1].second == "no.json");
}

TEST_CASE("the short form is laid over the study")
{
  const TemporaryFolder folder;
  folder.write("scene.json", "{}");
  const auto file = folder.write(
      "study.json",
      study_with(R"({"repeat": 5, "set": {"/a": 1, "/b": 2}, "short": {"repeat": 1, "set": {"/a": 3}}})").dump());

  const tools::study::Study whole = tools::study::read_study(file, false);
  const tools::study::Study in_short = tools::study::read_study(file, true);

  CHECK(whole.repeat == 5);
  CHECK(in_short.repeat == 1);
  CHECK(in_short.settings == tools::study::Settings{{"/a", 3}, {"/b", 2}});
}

TEST_CASE("a number of the summary stands instead of a column")
{
  const auto asking = [](const std::string& quantity) {
    return problems_of_study(R"({"quantities": [)" + quantity + "]}");
  };
  CHECK(asking(R"({"name": "error", "summary": "/energy_error", "exact": 0})").empty());
  CHECK_THAT(asking(R"({"name": "error", "summary": "energy_error"})"),
             Contains("study.json#/quantities/0/summary: \"energy_error\"; expected a JSON pointer"));
  CHECK_THAT(asking(R"({"name": "error", "summary": "/energy_error", "column": "x"})"),
             Contains("study.json#/quantities/0/column: given beside summary"));
  CHECK_THAT(asking(R"({"name": "error", "summary": "/energy_error", "take": "last"})"),
             Contains("study.json#/quantities/0/take: given beside summary"));
}

TEST_CASE(
    "an entry of the failure catalogue names a quantity with an exact answer, and two methods with one point each")
{
  const auto entry_with = [](const std::string& patch) {
    Json entry = Json::parse(R"({
      "methods": [{ "name": "a" }, { "name": "b" }],
      "quantities": [{ "name": "depth", "column": "punch.depth[m]", "take": "greatest", "exact": 1 }],
      "stability": { "quantity": "depth", "threshold": 0.1, "fails": "a", "survives": "b", "symptom": "noise",
                     "monitor": "depth" }
    })");
    entry.merge_patch(Json::parse(patch));
    return problems_of_study(entry.dump());
  };
  const std::string place = "study.json#/stability/";

  CHECK(entry_with("{}").empty());
  CHECK(entry_with(R"({"quantities": [{"name": "depth", "column": "x"}], "reference": {"set": {}}})").empty());
  CHECK_THAT(entry_with(R"({"quantities": [{"name": "depth", "column": "x"}]})"),
             Contains(place + "quantity: \"depth\"; expected the name of a quantity with an exact answer"));
  CHECK_THAT(entry_with(R"({"stability": {"quantity": "speed"}})"), Contains(place + "quantity: \"speed\""));
  CHECK_THAT(entry_with(R"({"stability": {"threshold": 0}})"), Contains(place + "threshold: 0"));
  CHECK_THAT(entry_with(R"({"stability": {"threshold": null}})"), Contains(place + "threshold: missing"));
  CHECK_THAT(entry_with(R"({"stability": {"fails": null}})"), Contains(place + "fails: missing"));
  CHECK_THAT(entry_with(R"({"stability": {"survives": null}})"), Contains(place + "survives: missing"));
  CHECK_THAT(entry_with(R"({"stability": {"fails": "c"}})"),
             Contains(place + "fails: \"c\"; expected the name of a method"));
  CHECK_THAT(entry_with(R"({"stability": {"fails": "b"}})"), Contains(place + "survives: \"b\", which fails"));
  CHECK_THAT(entry_with(R"({"stability": {"symptom": ""}})"), Contains(place + "symptom: missing"));
  CHECK_THAT(entry_with(R"({"sweep": {"/h": [1, 2]}})"), Contains(place + "fails: \"a\", of several points"));
}

}  // namespace test_read_study
