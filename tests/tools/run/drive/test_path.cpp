#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/errors.hpp"
#include "tools/run/drive/path.hpp"

namespace test_path
{

using namespace tamp;
using components::BadValue;
using tools::DeformationPath;
using tools::PathRow;

namespace
{

Matrix<3> diagonal(double xx, double yy, double zz)
{
  return Vector<3>(xx, yy, zz).asDiagonal();
}

const Matrix<3> identity = Matrix<3>::Identity();
const Vector<3> z(0, 0, 1);

/// The row that a path is refused for; -2 if it is not.
std::ptrdiff_t refused_row(std::vector<PathRow> rows)
{
  try {
    DeformationPath path(std::move(rows));
  } catch (const BadValue& bad) {
    return bad.row;
  }
  return -2;
}

}  // namespace

TEST_CASE("between rows time and deformation go evenly from the one to the other")
{
  const DeformationPath path({{0, identity}, {2, diagonal(3, 1, 1)}, {3, diagonal(3, 0.5, 1)}});

  CHECK(path.n_segments() == 2);
  CHECK(path.time(0, 0.25) == 0.5);
  CHECK(path.deformation_gradient(0, 0.25).isApprox(diagonal(1.5, 1, 1)));
  CHECK(path.deformation_gradient(1, 0.5).isApprox(diagonal(3, 0.75, 1)));
  CHECK(path.deformation_gradient(1, 1) == diagonal(3, 0.5, 1));
}

TEST_CASE("between rows of the same volume it stays the same, and rows are met exactly")
{
  const Matrix<3> compressed = diagonal(0.8, 1 / std::sqrt(0.8), 1 / std::sqrt(0.8));
  const DeformationPath path({{0, identity}, {1, compressed}, {2, identity}});

  for (const double fraction : {0.1, 0.5, 0.9}) {
    CHECK(path.deformation_gradient(0, fraction).determinant() == Approx(1).epsilon(1e-14));
    CHECK(path.deformation_gradient(1, fraction).determinant() == Approx(1).epsilon(1e-14));
  }
  CHECK(path.deformation_gradient(0, 1) == compressed);
  CHECK(path.deformation_gradient(1, 1) == identity);
}

TEST_CASE("a path in uniaxial strain stays one between its rows, and a deformation that is held stays to the bit")
{
  const Matrix<3> held = diagonal(0.7, 1.1, 1.3);
  const DeformationPath path({{0, identity}, {1, diagonal(0.9, 1, 1)}, {2, held}, {3, held}});

  CHECK(path.deformation_gradient(0, 0.25) == diagonal(0.75 + 0.25 * 0.9, 1, 1));
  CHECK(path.deformation_gradient(2, 0.5) == held);
}

TEST_CASE("the angle of the superposed rotation goes evenly too, and the rotation stands on the left")
{
  const DeformationPath path({{0, identity}, {1, diagonal(2, 1, 1), std::numbers::pi, 5 * z}});

  const Matrix<3> half_way = path.deformation_gradient(0, 0.5);

  // A quarter turn about z takes x to y.
  CHECK(half_way.isApprox((Matrix<3>() << 0, -1, 0, 1.5, 0, 0, 0, 0, 1).finished()));
  CHECK(path.unturned(0, 0.5).isApprox(diagonal(1.5, 1, 1)));
}

TEST_CASE("a rotation that ends at a row keeps its axis on the way there")
{
  const DeformationPath path({{0, identity, 0.6, z}, {1, identity, 0, Vector<3>::Zero()}});

  CHECK(path.deformation_gradient(0, 0.5).isApprox(Eigen::AngleAxisd(0.3, z).toRotationMatrix()));
}

TEST_CASE("a path of one row is refused, and so are times that repeat or go back, at their row")
{
  CHECK(refused_row({{0, identity}}) == -1);
  CHECK(refused_row({{0, identity}, {0, identity}}) == 1);
  CHECK(refused_row({{0, identity}, {1, identity}, {0.5, identity}}) == 2);
}

TEST_CASE("a deformation that turns inside out is refused, at a row and on the way to it")
{
  CHECK(refused_row({{0, identity}, {1, diagonal(-1, 1, 1)}}) == 1);
  CHECK(refused_row({{0, diagonal(1, 0, 1)}, {1, identity}}) == 0);
  // Half a turn about z: both ends are sound, the straight way between them passes det F = 0 in its middle.
  CHECK(refused_row({{0, identity}, {1, diagonal(-1, -1, 1)}}) == 1);
  CHECK(refused_row({{0, identity}, {1, diagonal(1e-3, 1e-3, 1)}}) == -2);
}

TEST_CASE("a rotation needs an axis, and keeps it from one turned row to the next")
{
  CHECK(refused_row({{0, identity}, {1, identity, 0.1, Vector<3>::Zero()}}) == 1);
  CHECK(refused_row({{0, identity, 0.1, z}, {1, identity, 0.2, Vector<3>(1, 0, 0)}}) == 1);
  CHECK(refused_row({{0, identity, 0.1, z}, {1, identity}, {2, identity, 0.2, Vector<3>(1, 0, 0)}}) == -2);
}

}  // namespace test_path
