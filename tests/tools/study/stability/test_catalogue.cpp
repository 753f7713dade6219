#include "tools/study/stability/catalogue.hpp"

#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace test_catalogue
{

using namespace tamp;
using namespace tamp::tools::stability;
using Catch::Contains;
using tools::Json;

namespace
{

tools::study::Study study_of_an_entry()
{
  tools::study::Study study;
  study.file = "noise.json";
  study.title = "Noise";
  study.stability = tools::study::Stability{"way", 0.1, "bad", "good", "a din", "null_space"};
  return study;
}

Json point(const std::string& method, const Json& error, const std::string& ended = "done")
{
  Json point{{"method", method},
             {"ended", ended},
             {"errors", Json::object()},
             {"command", "tamp run " + method},
             {"folder", ended == "refused" ? "" : "points/" + method}};
  if (error.is_number()) point["errors"]["way"] = error;
  return point;
}

Entry entry_with(const Json& failing, const Json& surviving, const std::filesystem::path& folder = "none")
{
  return entry_of(study_of_an_entry(), {{"points", {surviving, failing}}}, folder);
}

}  // namespace

TEST_CASE("a method fails by three thresholds or by becoming unstable, and by nothing else")
{
  const Json good = point("good", 0.01);

  CHECK(entry_with(point("bad", 0.31), good).failed());
  CHECK_FALSE(entry_with(point("bad", 0.29), good).failed());
  CHECK(entry_with(point("bad", nullptr, "unstable"), good).failed());
  CHECK_FALSE(entry_with(point("bad", nullptr, "limit"), good).failed());
  CHECK_FALSE(entry_with(point("bad", nullptr, "refused"), good).failed());
  CHECK_FALSE(entry_with(point("bad", nullptr), good).failed());
}

TEST_CASE("a method survives within a third of the threshold, if it comes to its end")
{
  const Json bad = point("bad", 1);

  CHECK(entry_with(bad, point("good", 0.033)).survived());
  CHECK_FALSE(entry_with(bad, point("good", 0.034)).survived());
  CHECK_FALSE(entry_with(bad, point("good", nullptr, "unstable")).survived());
  CHECK_FALSE(entry_with(bad, point("good", nullptr)).survived());
}

TEST_CASE("an entry is as told if one method fails and the other survives")
{
  CHECK(entry_with(point("bad", 1), point("good", 0)).is_as_expected());
  CHECK_FALSE(entry_with(point("bad", 1), point("good", 1)).is_as_expected());
  CHECK_FALSE(entry_with(point("bad", 0), point("good", 0)).is_as_expected());
}

TEST_CASE("the count of an entry's monitor is that of the run that fails, where it has one")
{
  const test::TemporaryFolder folder;
  const auto count_with = [&](const std::string& summary) {
    std::filesystem::create_directories(folder.path() / "points/bad");
    folder.write("points/bad/summary.json", summary);
    return entry_with(point("bad", 1), point("good", 0), folder.path()).first_count;
  };

  CHECK(count_with(R"({"monitors": {"null_space": {"count": 7}, "substeps": 3}})") == 7);
  CHECK_FALSE(count_with(R"({"monitors": {"null_space": 7}})"));
  CHECK_FALSE(count_with(R"({"monitors": {"substeps": 3}})"));
  CHECK_FALSE(count_with(R"({"steps": 3})"));
  CHECK_THROWS_AS(count_with("{"), runtime::FileError);
  CHECK_FALSE(entry_with(point("bad", 1), point("good", 0)).first_count);
  CHECK_FALSE(entry_with(point("bad", nullptr, "refused"), point("good", 0), folder.path()).first_count);
}

TEST_CASE("the table has a row for each entry, and shows which is not as told")
{
  const Entry sound = entry_with(point("bad", nullptr, "unstable"), point("good", 0.012));
  const Entry unsound = entry_with(point("bad", 0.2), point("good", 0));

  const std::string table = to_markdown({sound, unsound});

  CHECK_THAT(table, Contains("| noise | bad   | unstable | 0.1       | good     | 0.012 | a din   | yes     |"));
  CHECK_THAT(table, Contains("| noise | bad   | 0.2      | 0.1       | good     | 0     | a din   | **NO**  |"));
}

TEST_CASE("the table of monitors has the runs next to each limit: that which warns, and that which survives silent")
{
  const auto with_shares = [](double failing, double surviving) {
    Entry entry = entry_with(point("bad", 1), point("good", 0.01));
    entry.failing.shares_of_limits = {{"null_space", failing}};
    entry.surviving.shares_of_limits = {{"null_space", surviving}};
    return entry;
  };

  const std::string table = monitors_to_markdown({with_shares(4, 0.2), with_shares(3, 0.1), with_shares(0.9, 2.5)});

  CHECK_THAT(table,
             Contains("| null_space | 2.5           | noise, good (0.01) | 0.2           | noise, good (0.01) |"));
}

TEST_CASE("shares of limits are those of the summaries of both runs, and of monitors alone")
{
  const test::TemporaryFolder folder;
  for (const char* name : {"bad", "good"}) std::filesystem::create_directories(folder.path() / "points" / name);
  folder.write("points/bad/summary.json", R"({"monitors": {"null_space": {"share": 0.5, "limit": 0.25}, "steps": 3}})");
  folder.write("points/good/summary.json", R"({"monitors": {"null_space": {"share": 0, "limit": 0.25}}})");

  const Entry entry = entry_with(point("bad", 1), point("good", 0), folder.path());

  CHECK(entry.failing.shares_of_limits == std::map<std::string, double>{{"null_space", 2}});
  CHECK(entry.surviving.shares_of_limits == std::map<std::string, double>{{"null_space", 0}});
}

TEST_CASE("the list says of each entry what failed and what survived")
{
  const Json list = to_list({entry_with(point("bad", 0.2), point("good", 0))});

  CHECK(list == Json::parse(R"([{"name": "noise", "failing_method": "bad", "symptom": "a din", "failed": false,
                                "surviving_method": "good", "survived": true, "monitor": "null_space",
                                "first_count": null}])"));
}

}  // namespace test_catalogue
