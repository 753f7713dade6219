#include <catch2/catch.hpp>
#include <cmath>

#include "components/materials/tabular_cap.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace test_yield_table
{

using namespace tamp;
using namespace tamp::test;
using Catch::Matchers::Contains;

constexpr const char* published =
    R"({"Vaango_tabular_data": {"Data": {"Pressure": [-1e4, 1e6, 1e8], "SqrtJ2": [0, 6e5, 5e7]}}})";

/// sqrt(J2) at yield under 1 MPa, far below the cap, of the sand with this yield table.
double strength(const std::string& table, const std::string& content, const std::vector<std::string>& assignments = {})
{
  const TemporaryFolder folder;
  write_sand(folder);
  std::vector<std::string> all{"/yield/file=" + folder.write(table, content).string()};
  all.insert(all.end(), assignments.begin(), assignments.end());
  const auto sand =
      std::get<components::TabularCap>(tools::read_checked_material(folder.path() / "sand.json", all).material.model);
  return sand.parameters().yield.strength(1e6).value;
}

std::string problems(const std::string& table, const std::string& content,
                     const std::vector<std::string>& assignments = {})
{
  const TemporaryFolder folder;
  return problems_of_reading(folder, [&] {
    write_sand(folder);
    std::vector<std::string> all{"/yield/file=" + folder.write(table, content).string()};
    all.insert(all.end(), assignments.begin(), assignments.end());
    tools::read_checked_material(folder.path() / "sand.json", all);
  });
}

TEST_CASE("a strength given as q is sqrt(3) times less than one given as sqrt(J2)")
{
  const std::string rows = "-1e4,0\n1e6,6e5\n1e8,5e7\n";

  CHECK(strength("y.csv", "pressure[Pa],sqrt_J2[Pa]\n" + rows) == 6e5);
  CHECK(strength("y.csv", "pressure[Pa],q[Pa]\n" + rows) == 6e5 / std::sqrt(3.0));
  CHECK(strength("y.csv", "q[Pa],pressure[Pa]\n0,-1e4\n6e5,1e6\n5e7,1e8\n") == 6e5 / std::sqrt(3.0));
}

TEST_CASE("a published strength is what the scene says it is")
{
  CHECK(strength("y.json", published, {"/yield/measure=sqrt_J2"}) == 6e5);
  CHECK(strength("y.json", published, {"/yield/measure=q"}) == 6e5 / std::sqrt(3.0));
}

TEST_CASE("a published strength of which nothing is said is refused, whatever its column is called")
{
  CHECK_THAT(problems("y.json", published),
             Contains("sand.json#/yield/measure: missing; expected \"q\" or \"sqrt_J2\""));
}

TEST_CASE("a measure that contradicts the table's heading is refused, and one that repeats it is not")
{
  const std::string table = "pressure[Pa],q[Pa]\n-1e4,0\n1e6,6e5\n";

  CHECK_THAT(problems("y.csv", table, {"/yield/measure=sqrt_J2"}),
             Contains("#/yield/measure: \"sqrt_J2\"; expected none, or what y.csv has in its heading, q[Pa]"));
  CHECK(problems("y.csv", table, {"/yield/measure=q"}).empty());
}

TEST_CASE("a yield table with a column of neither name, or of both, is refused with its line")
{
  CHECK_THAT(problems("y.csv", "# made up\npressure[Pa],strength[Pa]\n-1e4,0\n1e6,6e5\n"),
             Contains("y.csv:2: columns pressure[Pa],strength[Pa]; expected pressure[Pa],q[Pa] or "
                      "pressure[Pa],sqrt_J2[Pa]"));
  CHECK_THAT(problems("y.csv", "pressure[Pa],q[Pa],sqrt_J2[Pa]\n-1e4,0,0\n1e6,6e5,3e5\n"),
             Contains("y.csv:1: columns pressure[Pa],q[Pa],sqrt_J2[Pa]; expected "));
}

TEST_CASE("a measure that is none is reported once")
{
  CHECK(problems("y.csv", "pressure[Pa],q[Pa]\n-1e4,0\n1e6,6e5\n", {"/yield/measure=tau"}) ==
        "--set#/yield/measure: \"tau\"; expected one of q, sqrt_J2");
}

TEST_CASE("rows of a yield table that its concave hull lifts by more than 2 % are remarked, as the file has them")
{
  const TemporaryFolder folder;
  const auto scene = write_scene_with_sand(folder);
  const auto remarks = [&](const std::string& table) {
    folder.write("tables/yield.csv", table);
    return tools::read_scene(scene).remarks;
  };

  // On the straight line from the vertex to the last row strength is 0.5 of the pressure beyond the vertex.
  const auto of_q = remarks("pressure[Pa],q[Pa]\n-2e4,0\n2e4,1e4\n4e4,2.95e4\n8e4,5e4\n");
  const auto of_sqrt_j2 = remarks("pressure[Pa],sqrt_J2[Pa]\n-2e4,0\n2e4,0\n8e4,5e4\n");

  REQUIRE(of_q.size() == 1);
  CHECK_THAT(of_q.front(),
             Contains("tables/yield.csv:3: lifted by 100 % to the concave hull of the table: at 20000 Pa q "
                      "is 10000 Pa as measured, 20000 Pa as used"));
  REQUIRE(of_sqrt_j2.size() == 1);
  CHECK_THAT(of_sqrt_j2.front(), Contains("tables/yield.csv:3: lifted to the concave hull of the table: at 20000 Pa "
                                          "sqrt(J2) is 0 Pa as measured, 20000 Pa as used"));
}

}  // namespace test_yield_table
