#include "tools/run/drive/laboratory_test.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tools/run/drive/drive.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace test_laboratory_test
{

using namespace tamp;
using components::DruckerPrager;
using components::Hypoelastic;
using tools::LaboratoryTest;
using tools::MaterialPoint;

namespace
{

constexpr double K = 20e6, G = 12e6;
constexpr double E = 9 * K * G / (3 * K + G), nu = (3 * K - 2 * G) / (2 * (3 * K + G));

const tasks::SceneMaterial elastic{"elastic", 2000, Hypoelastic{K, G}};

tasks::SceneMaterial soil(double cohesion)
{
  DruckerPrager model{K, G, 35, 10};
  model.cohesion = cohesion;
  return {"soil", 2000, model};
}

std::vector<MaterialPoint> points_of(const tasks::SceneMaterial& material, const LaboratoryTest& test)
{
  std::vector<MaterialPoint> points;
  tools::drive(material, test, 1e-3, [&](double, const MaterialPoint& point) { points.push_back(point); });
  return points;
}

/// Logarithm of a length over that at the start of the test.
double strain(const std::vector<MaterialPoint>& points, int axis)
{
  return std::log(points.back().deformation_gradient(axis, axis) / points.front().deformation_gradient(axis, axis));
}

double stress_change(const std::vector<MaterialPoint>& points, int component)
{
  return points.back().stress[component] - points.front().stress[component];
}

/// Sine of the friction angle, and the ratio of principal stresses at failure in triaxial compression, without
/// cohesion.
const double sine = std::sin(35 * std::numbers::pi / 180), ratio_at_failure = (1 + sine) / (1 - sine);

}  // namespace

TEST_CASE("an isotropic test goes from no stress to the pressure, and back in a cycle")
{
  const auto loaded = points_of(elastic, {.name = "isotropic"});
  const auto cycled = points_of(elastic, {.name = "isotropic", .n_cycles = 2});

  CHECK(loaded.front().stress.norm() == 0);
  CHECK(loaded.back().stress.isApprox(isotropic<6>(-100e3), 1e-9));
  CHECK(-std::log(loaded.back().volume) == Approx(100e3 / K).epsilon(1e-6));
  CHECK(cycled.back().stress.norm() < 1e-2);
  CHECK(cycled.back().deformation_gradient.isApprox(Matrix<3>::Identity()));
}

TEST_CASE("drained triaxial compression of an elastic point has its Young's modulus and Poisson's ratio")
{
  const auto points = points_of(elastic, {.name = "triaxial", .strain = 1e-3});

  CHECK(points.front().stress.isApprox(isotropic<6>(-100e3), 1e-9));
  CHECK(points.back().stress[1] == Approx(-100e3).epsilon(1e-9));
  CHECK(points.back().stress[2] == Approx(-100e3).epsilon(1e-9));
  CHECK(strain(points, 0) == Approx(std::log(1 - 1e-3)).epsilon(1e-9));
  CHECK(stress_change(points, 0) / strain(points, 0) == Approx(E).epsilon(1e-6));
  CHECK(strain(points, 1) / strain(points, 0) == Approx(-nu).epsilon(1e-6));
}

TEST_CASE("drained triaxial compression of a cone ends at Mohr and Coulomb's strength, with cohesion and without")
{
  for (const double cohesion : {0.0, 10e3}) {
    const auto points = points_of(soil(cohesion), {.name = "triaxial"});

    CAPTURE(cohesion);
    const double strength = ratio_at_failure * 100e3 + 2 * cohesion * std::sqrt(ratio_at_failure);
    CHECK(ratio_at_failure == Approx(3.690).epsilon(1e-4));
    CHECK(-points.back().stress[0] == Approx(strength).epsilon(1e-6));
    CHECK(points.back().stress[1] == Approx(-100e3).epsilon(1e-9));
  }
}

TEST_CASE("triaxial extension is a negative strain, and its strength that of the cone: q = M p")
{
  const auto points = points_of(soil(0), {.name = "triaxial", .strain = -0.05});

  const double slope = 6 * sine / (3 - sine), lateral = 100e3;
  // q = lateral - axial, p = (axial + 2 lateral) / 3
  const double axial = lateral * (1 - 2 * slope / 3) / (1 + slope / 3);
  CHECK(points.back().stress[0] == Approx(-axial).epsilon(1e-6));
}

TEST_CASE("an undrained test keeps the volume to round-off, and so the mean stress of an elastic point")
{
  for (const char* name : {"triaxial_undrained", "simple_shear_undrained"}) {
    CAPTURE(name);
    const auto points = points_of(elastic, {.name = name, .strain = 0.1, .n_cycles = 1});

    for (const MaterialPoint& point : points) {
      REQUIRE(point.deformation_gradient.determinant() / points.front().deformation_gradient.determinant() ==
              Approx(1).epsilon(1e-12));
      REQUIRE(point.volume / points.front().volume == Approx(1).epsilon(1e-12));
      // The strain measure of an increment is of second order in its size.
      REQUIRE(point.invariants().pressure == Approx(100e3).margin(1e-7 * K));
    }
  }
}

TEST_CASE("undrained triaxial compression of an elastic point has a stress difference of 3 G times its strain")
{
  const auto points = points_of(elastic, {.name = "triaxial_undrained", .strain = 0.01});

  CHECK(points.back().invariants().q() == Approx(-3 * G * std::log(0.99)).epsilon(1e-5));
}

TEST_CASE("an oedometer test has the constrained modulus and K0 of elasticity, and no lateral strain")
{
  const auto points = points_of(elastic, {.name = "oedometer", .strain = 0.05});

  CHECK(points.front().stress[0] == Approx(-100e3).epsilon(1e-9));
  CHECK(stress_change(points, 0) / strain(points, 0) == Approx(K + 4 * G / 3).epsilon(1e-6));
  for (const MaterialPoint& point : points) {
    REQUIRE(point.deformation_gradient(1, 1) == 1);
    REQUIRE(point.stress[1] / point.stress[0] == Approx(nu / (1 - nu)).epsilon(1e-6));
  }
}

TEST_CASE("simple shear keeps the normal stress on axis 2 and the lateral lengths, and has the modulus G")
{
  const auto points = points_of(elastic, {.name = "simple_shear", .lateral_ratio = 0.5, .strain = 1e-3});

  const Matrix<3>&from = points.front().deformation_gradient, &to = points.back().deformation_gradient;
  CHECK(points.front().stress[1] == Approx(-100e3).epsilon(1e-9));
  CHECK(points.front().stress[0] == Approx(-50e3).epsilon(1e-9));
  CHECK(points.back().stress[1] == Approx(-100e3).epsilon(1e-9));
  CHECK(to(0, 1) == Approx(1e-3 * from(1, 1)));
  CHECK(to(0, 0) == from(0, 0));
  CHECK(to(2, 2) == from(2, 2));
  // The shear strain is the angle, and the stresses of the start turn with the material: by half of it.
  const double turned = 0.5 * 1e-3 * (points.front().stress[1] - points.front().stress[0]);
  CHECK(points.back().stress[3] == Approx(G * 1e-3 + turned).epsilon(1e-4));
}

TEST_CASE("a test at constant mean stress keeps it, and shears an elastic point without a change of volume")
{
  const auto points = points_of(elastic, {.name = "constant_p", .lateral_ratio = 0.7, .strain = 0.01});

  for (const MaterialPoint& point : points) REQUIRE(point.invariants().pressure == Approx(80e3).epsilon(1e-8));
  CHECK(points.back().volume / points.front().volume == Approx(1).epsilon(1e-6));
  CHECK(points.front().stress[1] == Approx(-70e3).epsilon(1e-9));
}

TEST_CASE("at constant mean stress a cone ends at q = M p")
{
  const auto points = points_of(soil(0), {.name = "constant_p"});

  CHECK(points.back().invariants().pressure == Approx(100e3).epsilon(1e-8));
  CHECK(points.back().invariants().q() == Approx(6 * sine / (3 - sine) * 100e3).epsilon(1e-6));
}

TEST_CASE("a cycle goes to the strain and back to the length at the start")
{
  std::vector<double> stretch{0, 0, 0, 0, 0};
  const LaboratoryTest test{.name = "triaxial", .strain = 0.01, .n_cycles = 2};

  tools::drive(soil(0), test, 1e-3, [&](double time, const MaterialPoint& point) {
    if (time == std::floor(time)) stretch[static_cast<std::size_t>(time)] = point.deformation_gradient(0, 0);
  });

  CHECK(stretch[1] == Approx(0.99 * stretch[0]));
  CHECK(stretch[2] == stretch[0]);
  CHECK(stretch[3] == stretch[1]);
  CHECK(stretch[4] == stretch[0]);
}

TEST_CASE("a start beyond the strength is refused as such")
{
  // Active pressure is 1 / 3.69 of the axial stress.
  CHECK_NOTHROW(points_of(soil(0), {.name = "triaxial", .lateral_ratio = 0.28, .strain = 1e-3}));
  CHECK_THROWS_WITH(points_of(soil(0), {.name = "triaxial", .lateral_ratio = 0.26}),
                    Catch::EndsWith("at 0 s, on the way to the stress at the start"));
}

TEST_CASE("every test can be made of each shipped sand, from no stress on")
{
  for (const std::string file :
       {"concrete-sand/table.json", "concrete-sand/svr.json", "concrete-sand/mlp.json", "smooth-sand/table.json"}) {
    const auto sand = tools::read_checked_material(TAMP_SOURCE_DIR "/inputs/materials/" + file, {}).material;
    for (const std::string& name : tools::laboratory_test_names()) {
      CAPTURE(file, name);

      const auto points = points_of(sand, {.name = name, .strain = 0.02});

      CHECK(points.size() > 1);
      CHECK(points.back().stress[1] < 0);
    }
  }
}

}  // namespace test_laboratory_test
