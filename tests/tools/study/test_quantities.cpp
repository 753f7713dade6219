#include "tools/study/quantities.hpp"

#include <hdf5.h>

#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "tests/tools/problems.hpp"

namespace test_quantities
{

using namespace tamp;
using namespace tamp::test;
using namespace tamp::tools::study;

namespace
{

/// Answer of a quantity to a table of times and depths.
Answer taken(const Quantity& quantity, const std::string& rows = "0,1\n1,3\n2,2\n4,0\n")
{
  const TemporaryFolder folder;
  folder.write("history.csv", "time[s],depth[m]\n" + rows);
  return answer_of(Study{}, quantity, PointResult{End::done, "", {}, 1, folder.path()});
}

Quantity depth(Take take, double time = 0)
{
  Quantity quantity{"depth", take, "depth[m]"};
  quantity.time = time;
  return quantity;
}

}  // namespace

TEST_CASE("numbers are taken of a column")
{
  CHECK(taken(depth(Take::greatest)).value == 3);
  CHECK(taken(depth(Take::least)).value == 0);
  CHECK(taken(depth(Take::last)).value == 0);
  CHECK(taken(depth(Take::value, 3)).value == Approx(1));
  CHECK(taken(depth(Take::value, 9)).value == 0);
  CHECK(taken(depth(Take::mean, 0.5)).value == Approx(5. / 3));
  CHECK(std::isnan(taken(depth(Take::mean, 9)).value));
}

TEST_CASE("a number of the summary is taken where a pointer says, and missed where there is none")
{
  const TemporaryFolder folder;
  folder.write(
      "summary.json",
      R"({"energy_error": 0.25, "monitors": {"null_space": {"share": 0.5}}, "status": "done", "inputs": [1]})");
  const auto taken_at = [&](const std::string& pointer) {
    Quantity quantity{"number", Take::last, ""};
    quantity.summary = pointer;
    return answer_of(Study{}, quantity, PointResult{End::done, "", {}, 1, folder.path()}).value;
  };

  CHECK(taken_at("/energy_error") == 0.25);
  CHECK(taken_at("/monitors/null_space/share") == 0.5);
  CHECK_THROWS_WITH(taken_at("/monitors/fracture/share"),
                    Catch::Contains("#/quantities: \"number\": there is no number at /monitors/fracture/share"));
  CHECK_THROWS_WITH(taken_at("/inputs/99999999999999999999"), Catch::Contains("there is no number at /inputs/999"));
  CHECK_THROWS_WITH(taken_at("/status"), Catch::Contains("there is no number at /status"));
}

TEST_CASE("the value farthest from the exact answer may lie on either side of it")
{
  Quantity farthest = depth(Take::farthest);
  farthest.exact = 2.5;
  CHECK(taken(farthest).value == 0);
  farthest.exact = 1;
  CHECK(taken(farthest).value == 3);
}

TEST_CASE("what is kept is the last row over the first, of all columns that are added up")
{
  Quantity kept = depth(Take::kept);
  CHECK(taken(kept, "0,4\n1,9\n2,3\n").value == Approx(0.75));
  kept.plus = {"time[s]"};
  CHECK(taken(kept, "0,4\n1,9\n2,3\n").value == Approx(1.25));
}

TEST_CASE("the time of the greatest value is that of the parabola through its neighbours")
{
  // 5 - (t - 1.2)^2 at 0, 1 and 3
  CHECK(taken(depth(Take::time_of_greatest), "0,3.56\n1,4.96\n3,1.76\n").value == Approx(1.2));
  CHECK(taken(depth(Take::time_of_greatest), "0,3\n1,2\n").value == 0);
}

TEST_CASE("curves are apart by the greatest difference over the reference's greatest value")
{
  const Answer reference = taken(depth(Take::curve), "0,0\n1,4\n2,0\n");
  const Answer other = taken(depth(Take::curve), "0,0\n0.5,2\n1.5,3\n2,1\n");
  CHECK(distance(depth(Take::curve), reference, other) == Approx(1.5 / 4));
}

TEST_CASE("rows are apart relative to the reference's, where that is not 0")
{
  const Answer reference = taken(depth(Take::rows_max), "0,1\n1,2\n2,0\n");
  const Answer other = taken(depth(Take::rows_max), "0,1.1\n1,1.6\n2,5\n");
  CHECK(distance(depth(Take::rows_max), reference, other) == Approx(0.2));
  CHECK(distance(depth(Take::rows_rms), reference, other) == Approx(std::sqrt((0.01 + 0.04) / 2)));
}

TEST_CASE("nothing is said of rows that cannot be compared")
{
  const Quantity rows = depth(Take::rows_max);
  const Answer zeros = taken(rows, "0,0\n1,0\n"), two = taken(rows, "0,1\n1,2\n"), three = taken(rows);
  CHECK(std::isnan(distance(rows, zeros, two)));
  CHECK(std::isnan(distance(rows, two, three)));
  CHECK(std::isnan(distance(depth(Take::curve), taken(depth(Take::curve)), taken(depth(Take::curve), "0,x\n4,1\n"))));
}

TEST_CASE("a column that is not there is reported, with those that are")
{
  CHECK_THAT(problems_of_reading(TemporaryFolder(),
                                 [] {
                                   taken({"speed", Take::last, "speed[m/s]"});
                                 }),
             Catch::Contains("there is no column \"speed[m/s]\"; expected one of depth[m], time[s]"));
}

TEST_CASE("a history with a row of another length is refused, with the row")
{
  const std::string short_row = "0,1\n1\n2,3\n", long_row = "0,1\n1,2,3\n";
  CHECK_THROWS_WITH(taken(depth(Take::last), short_row), Catch::Contains("history.csv:3: 1 values"));
  CHECK_THROWS_AS(taken(depth(Take::curve), short_row), runtime::FileError);
  CHECK_THROWS_WITH(taken(depth(Take::last), long_row), Catch::Contains("history.csv:3: 3 values"));
}

TEST_CASE("fields without outputs are refused")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "fields.h5").string();
  H5Fclose(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  Quantity lowest{"lowest", Take::quantile, ""};
  lowest.field = "position";

  CHECK_THROWS_WITH(answer_of(Study{}, lowest, PointResult{End::done, "", {}, 1, folder.path()}),
                    Catch::Contains("fields.h5: has no output of fields"));
}

TEST_CASE("the unit of a quantity is its column's")
{
  CHECK(unit_of(depth(Take::greatest)) == "m");
  CHECK(unit_of(depth(Take::time_of_greatest)) == "s");
  CHECK(unit_of({"strain", Take::last, "strain[-]"}).empty());
}

}  // namespace test_quantities
