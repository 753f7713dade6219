#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>

#include "tools/run/raster.hpp"

namespace test_raster
{

using tamp::tools::Raster;

namespace
{

/// The materials of all cells, a line a row, the highest first.
std::string drawn(const Raster& raster)
{
  const auto [nx, ny] = raster.n_cells();
  std::string text;
  for (int j = ny - 1; j >= 0; --j) {
    for (int i = 0; i < nx; ++i) {
      const int material = raster.cells()[static_cast<std::size_t>(j * nx + i)].material;
      text += material == Raster::nobody ? "." : std::to_string(material);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("a particle is a square about its place, and nothing is drawn beside it")
{
  Raster raster({0, 0}, {6, 3}, 6);

  raster.add({2, 1}, 1, 0, 0, 5);

  CHECK(raster.cell_size() == 1);
  CHECK(drawn(raster) ==
        "......\n"
        ".00...\n"
        ".00...\n");
  CHECK(raster.cells()[1].speed == 5);
}

TEST_CASE("of two particles the nearer one is drawn, in whatever order they come")
{
  const bool is_first = GENERATE(true, false);
  Raster raster({0, 0}, {4, 1}, 4);

  for (const bool now : {is_first, !is_first}) raster.add({now ? 1.0 : 3.0, 0.5}, 2, 0, now ? 0 : 1, 0);

  CHECK(drawn(raster) == "0011\n");
}

TEST_CASE("in a slab the particle that is nearer to its plane is drawn")
{
  Raster raster({0, 0}, {1, 1}, 1);

  raster.add({0.5, 0.5}, 1, 0.2, 3, 0);
  raster.add({0.5, 0.5}, 1, 0.4, 4, 0);

  CHECK(drawn(raster) == "3\n");
}

TEST_CASE("a particle far outside draws nothing, and one that is smaller than a cell still one cell")
{
  Raster raster({0, 0}, {3, 1}, 3);

  raster.add({1e30, -1e30}, 1, 0, 0, 0);
  raster.add({1.4, 0.6}, 1e-9, 0, 1, 0);

  CHECK(drawn(raster) == ".1.\n");
}

TEST_CASE("a box without an inside, or without an end, has no picture")
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double upper = GENERATE_COPY(0.0, -1.0, infinity, std::numeric_limits<double>::quiet_NaN());

  CHECK_THROWS_AS(Raster({0, 0}, {1, upper}, 4), std::out_of_range);
  CHECK_THROWS_AS(Raster({0, 0}, {upper, 1}, 4), std::out_of_range);
}

}  // namespace test_raster
