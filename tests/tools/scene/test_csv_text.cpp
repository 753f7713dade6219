#include "tools/scene/tables/csv_text.hpp"

#include <catch2/catch.hpp>

namespace test_csv_text
{

using tamp::tools::csv_cell;

TEST_CASE("text of a CSV is no formula to a spreadsheet, and all other cells are as they were")
{
  CHECK(csv_cell("=2+5") == "'=2+5");
  CHECK(csv_cell("=HYPERLINK(\"http://a\",1)") == "\"'=HYPERLINK(\"\"http://a\"\",1)\"");
  CHECK(csv_cell("+1") == "'+1");
  CHECK(csv_cell("-2+3") == "'-2+3");
  CHECK(csv_cell("@SUM(A1)") == "'@SUM(A1)");
  CHECK(csv_cell("\t=1") == "'\t=1");
  CHECK(csv_cell("\r=1") == "\"'\r=1\"");

  CHECK(csv_cell(-2.5) == "-2.5");
  CHECK(csv_cell({1, 2}) == "\"[1,2]\"");
  CHECK(csv_cell(nullptr).empty());
  CHECK(csv_cell("").empty());
  CHECK(csv_cell("a=b - c") == "a=b - c");
  CHECK(csv_cell(" =1") == " =1");
  CHECK(csv_cell("1, \"2\"") == "\"1, \"\"2\"\"\"");
}

}  // namespace test_csv_text
