#include <catch2/catch.hpp>
#include <cmath>

#include "tasks/simulation_error.hpp"
#include "tools/run/drive/drive.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace test_mixed_drive
{

using namespace tamp;
using components::DruckerPrager;
using components::Hypoelastic;
using tools::component_control;
using tools::MaterialPoint;
using tools::MixedPath;
using tools::StressControl;

namespace
{

const Matrix<3> identity = Matrix<3>::Identity();

const std::vector<StressControl> all_normal{component_control(0, 0), component_control(1, 1), component_control(2, 2)};

tasks::SceneMaterial soil(double friction_angle, double cohesion)
{
  DruckerPrager model{20e6, 12e6, friction_angle};
  model.dilation_angle = friction_angle / 4;
  model.cohesion = cohesion;
  return {"soil", 2000, model};
}

tasks::SceneMaterial shipped(const std::string& file)
{
  return tools::read_checked_material(TAMP_SOURCE_DIR "/inputs/materials/" + file, {}).material;
}

template <class Path>
std::vector<MaterialPoint> points_along(const tasks::SceneMaterial& material, const Path& path)
{
  std::vector<MaterialPoint> points;
  tools::drive(material, path, 1e-3, [&](double, const MaterialPoint& point) { points.push_back(point); });
  return points;
}

}  // namespace

TEST_CASE("a point with one stress and two stretches prescribed has the stress of Hooke's law in logarithmic strains")
{
  // Plane strain, elastic all the way: K 555.6 kPa, G 416.7 kPa, and a strength that is never reached.
  const double bulk = 1e6 / 1.8, shear = 1e6 / 2.4;
  DruckerPrager model{bulk, shear, 35, 20, 10e3};
  const MixedPath path({component_control(2, 2)},
                       {{0, identity, {0}}, {1, Vector<3>(0.95, 1, 1).asDiagonal(), {-1e5}}});

  const auto points = points_along({"soil", 2000, model}, path);

  const double lambda = bulk - 2 * shear / 3, axial = std::log(0.95);
  const double lateral = (-1e5 - lambda * axial) / (lambda + 2 * shear);
  const MaterialPoint& end = points.back();
  CHECK(end.stress[2] == Approx(-1e5).epsilon(1e-9));
  CHECK(end.stress[0] == Approx(lambda * (axial + lateral) + 2 * shear * axial).epsilon(1e-6));
  CHECK(end.stress[1] == Approx(lambda * (axial + lateral)).epsilon(1e-6));
  CHECK(std::log(end.deformation_gradient(2, 2)) == Approx(lateral).epsilon(1e-6));
}

TEST_CASE("controlled stress goes in a straight line between rows, whatever the material")
{
  const MixedPath path(all_normal, {{0, identity, {0, 0, 0}}, {1, identity, {-2e5, -1e5, -1e5}}});
  const std::vector<tasks::SceneMaterial> materials{{"steel", 8000, Hypoelastic{10e9, 7e9}},
                                                    {"rubber", 1000, components::NeoHookean{20e6, 12e6}},
                                                    soil(35, 0),
                                                    soil(0, 100e3),
                                                    shipped("concrete-sand/table_sqrt_J2.json"),
                                                    shipped("concrete-sand/svr_sqrt_J2.json"),
                                                    shipped("concrete-sand/mlp_sqrt_J2.json"),
                                                    shipped("smooth-sand/table.json")};
  for (const tasks::SceneMaterial& material : materials) {
    CAPTURE(material.model.index());

    tools::drive(material, path, 1e-3, [&](double time, const MaterialPoint& point) {
      REQUIRE(point.stress[0] == Approx(-2e5 * time).margin(0.01));
      REQUIRE(point.stress[1] == Approx(-1e5 * time).margin(0.01));
      REQUIRE(point.stress[2] == Approx(-1e5 * time).margin(0.01));
    });
  }
}

TEST_CASE("a point starts at the stress of the first row, with prescribed stretches as they are given there")
{
  const MixedPath path({component_control(1, 1), component_control(2, 2)},
                       {{5, identity, {-1e5, -1e5}}, {6, identity, {-1e5, -1e5}}});

  const auto points = points_along({"steel", 8000, Hypoelastic{10e6, 6e6}}, path);

  // Without axial strain the lateral ones are e = s / (2K + 2G/3), and the axial stress is 2 (K - 2G/3) e.
  CHECK(points.front().deformation_gradient(0, 0) == 1);
  CHECK(points.front().stress[1] == Approx(-1e5));
  CHECK(points.front().stress[0] == Approx(-1e5 * 2 * 6 / 24).epsilon(1e-6));
  CHECK((points.back().stress - points.front().stress).norm() == Approx(0).margin(1e-3));
}

TEST_CASE("prescribed shear stresses are found by F12, F13 and F23")
{
  const std::vector<StressControl> controls{component_control(0, 1), component_control(0, 2), component_control(1, 2)};
  const MixedPath path(controls, {{0, identity, {0, 0, 0}}, {1, identity, {3e3, -2e3, 1e3}}});

  const auto points = points_along({"steel", 8000, Hypoelastic{20e6, 10e6}}, path);

  const Matrix<3>& f = points.back().deformation_gradient;
  CHECK(f(0, 1) == Approx(3e-4).epsilon(1e-3));
  CHECK(f(0, 2) == Approx(-2e-4).epsilon(1e-3));
  CHECK(f(1, 2) == Approx(1e-4).epsilon(1e-3));
  CHECK(f.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm() == 0);
  CHECK(points.back().stress[3] == Approx(3e3).epsilon(1e-9));
  CHECK(points.back().stress[4] == Approx(1e3).epsilon(1e-9));
  CHECK(points.back().stress[5] == Approx(-2e3).epsilon(1e-9));
}

TEST_CASE("the deformation that a mixed path finds, prescribed in full, gives the same stress")
{
  const MixedPath path({component_control(1, 1), component_control(2, 2)},
                       {{0, identity, {0, 0}}, {1, Vector<3>(0.97, 1, 1).asDiagonal(), {-3e6, -2e6}}});
  const auto sand = shipped("concrete-sand/table.json");
  const auto points = points_along(sand, path);

  std::vector<tools::PathRow> rows;
  rows.reserve(points.size());
  for (const MaterialPoint& point : points) {
    rows.push_back({static_cast<double>(rows.size()), point.deformation_gradient});
  }
  const auto replayed = points_along(sand, tools::DeformationPath(rows));

  REQUIRE(replayed.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(replayed[i].stress == points[i].stress);
}

TEST_CASE("no increment of a mixed path strains more than is allowed")
{
  const MixedPath path({component_control(1, 1), component_control(2, 2)},
                       {{0, identity, {-1e5, -1e5}}, {1, Vector<3>(0.9, 1, 1).asDiagonal(), {-1e5, -1e5}}});

  const auto points = points_along(soil(35, 0), path);

  for (std::size_t i = 1; i < points.size(); ++i) {
    const Matrix<3> f = points[i].deformation_gradient * points[i - 1].deformation_gradient.inverse();
    REQUIRE(f.diagonal().array().log().matrix().norm() < 1.001e-3);
  }
}

TEST_CASE("a stress beyond the strength is refused with time, row, component, and the stress reached and wanted")
{
  const MixedPath path(
      all_normal, {{0, identity, {0, 0, 0}}, {1, identity, {-1e5, -1e5, -1e5}}, {2, identity, {-5e5, -1e5, -1e5}}});
  std::vector<MaterialPoint> points;

  // Cohesive soil without friction fails at a difference of 2 c: 1.25 s is where S11 is -200 kPa.
  CHECK_THROWS_MATCHES(
      tools::drive(soil(0, 50e3), path, 1e-3, [&](double, const MaterialPoint& point) { points.push_back(point); }),
      tasks::SimulationError,
      Catch::Message(
          "the material cannot follow: S11 is -200000 Pa, and should be -500000 Pa at the end: at 1.25 s, on "
          "the way to row 3 of the path"));
  CHECK(points.back().stress[0] == Approx(-2e5));
}

TEST_CASE("a mixed path is refused for times that do not rise, and for stretches and a first determinant not above 0")
{
  const auto refused_row = [](const std::vector<tools::MixedRow>& rows) -> std::ptrdiff_t {
    try {
      MixedPath path({component_control(2, 2)}, rows);
    } catch (const components::BadValue& bad) {
      return bad.row;
    }
    return -2;
  };
  Matrix<3> flipped = identity;
  flipped.topLeftCorner<2, 2>() << 1, 2, 2, 1;

  CHECK(refused_row({{0, identity, {0}}}) == -1);
  CHECK(refused_row({{0, identity, {0}}, {0, identity, {0}}}) == 1);
  CHECK(refused_row({{0, identity, {0}}, {1, Vector<3>(1, -1, 0).asDiagonal(), {0}}}) == 1);
  CHECK(refused_row({{0, flipped, {0}}, {1, identity, {0}}}) == 0);
  CHECK(refused_row({{0, identity, {0}}, {1, Vector<3>(1, 1, 0).asDiagonal(), {0}}}) == -2);
}

}  // namespace test_mixed_drive
