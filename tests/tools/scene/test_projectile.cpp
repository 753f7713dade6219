#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include "components/geometry/closed_mesh.hpp"
#include "components/geometry/fill.hpp"
#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_projectile
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double pi = std::numbers::pi;
/// The projectile's own frame, moved so that its tip is at (10 mm, 10 mm, 10 mm).
const Vector<3> tip(0.01, 0.01, 0.01);

components::Solid<3> projectile(const std::string& shape)
{
  const std::string geometry = R"({"type":"transform","translation":[0.01,0.01,0.01],"of":)" + shape + "}";
  const TemporaryFolder folder;
  const auto scene = tools::read_scene(
      folder.write("small.json", small_scene),
      {"/dimension=3", "/grid/upper=[0.06,0.02,0.02]", "/grid/cell_size=0.002", "/bodies/block/geometry=" + geometry});
  return std::get<components::Solid<3>>(scene.scene.bodies.at(0).solid);
}

components::Solid<3> drawn()
{
  return projectile(R"({"file":")" TAMP_SOURCE_DIR R"(/inputs/uxo/projectile.json"})");
}

/// Its surface, in millimetres, as inputs/uxo/README.md has it made.
components::Solid<3> meshed()
{
  const TemporaryFolder folder;
  const std::string stl = (folder.path() / "projectile.stl").string();
  const std::string root = TAMP_SOURCE_DIR;
  const Outcome made = outcome_of("python3 " + root + "/tools/python/tamp projectile-mesh " + root +
                                  "/inputs/uxo/projectile.json " + stl);
  INFO(made.err);
  REQUIRE(made.exit_code == 0);
  return projectile(R"({"type":"mesh","stl":")" + stl + R"(","scale":1e-3})");
}

/// A place by its distance from the tip along the axis, from the axis, and its angle about it.
Vector<3> place(double along, double radius, double angle)
{
  return tip + Vector<3>(along, radius * std::cos(angle), radius * std::sin(angle));
}

/// Volume of the body of revolution and of the fins beyond the boom [m^3].
double exact_volume()
{
  const double greatest = 5.8 * 5.8, boom = 2.05 * 2.05;
  // r^2 is a cubic between the tip, where it grows by 2 mm, the greatest diameter and the boom, where it is level.
  const double nose = 18.45 * greatest / 2 + 18.45 * 18.45 * 2 / 12, waist = 6.15 * (greatest + boom) / 2;
  const double root = 0.5 * std::sqrt(boom - 0.25) + boom * std::asin(0.5 / 2.05);
  return 1e-9 * (pi * (nose + waist + 16.4 * boom) + 6 * 8.2 * (6.15 - root));
}

}  // namespace

TEST_CASE("the projectile has the report's measures")
{
  const auto solid = drawn();
  const double between_fins = pi / 6;

  const components::Box<3> box = solid.bounding_box();
  CHECK(box.lower[0] == Approx(0.01));
  CHECK(box.upper[0] == Approx(0.051));
  CHECK(solid.contains(place(18.45e-3, 5.79e-3, between_fins)));
  CHECK_FALSE(solid.contains(place(18.45e-3, 5.81e-3, between_fins)));
  CHECK_FALSE(solid.contains(place(16e-3, 5.8e-3, between_fins)));
  for (const double along : {24.7e-3, 30e-3, 40.9e-3}) {
    CHECK(solid.contains(place(along, 2.04e-3, between_fins)));
    CHECK_FALSE(solid.contains(place(along, 2.06e-3, between_fins)));
  }
  for (int fin = 0; fin < 6; ++fin) {
    const double angle = fin * pi / 3;
    CHECK(solid.contains(place(32.9e-3, 6.14e-3, angle)));
    CHECK_FALSE(solid.contains(place(32.7e-3, 6.14e-3, angle)));
    CHECK_FALSE(solid.contains(place(36e-3, 6.16e-3, angle)));
    CHECK(solid.contains(place(36e-3, 4e-3, angle + 0.48 / 4)));
    CHECK_FALSE(solid.contains(place(36e-3, 4e-3, angle + 0.52 / 4)));
  }
}

TEST_CASE("the projectile's volume is the exact one within its stated error")
{
  const components::Volume volume = drawn().volume();

  CHECK(volume.error < 5e-4 * exact_volume());
  CHECK(std::abs(volume.value - exact_volume()) < 2 * volume.error);
}

TEST_CASE("the projectile's mesh is the projectile, but for the flats of its facets")
{
  if (!components::ClosedMesh::is_available) return;
  const auto solid = drawn(), mesh = meshed();
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> along(0, 0.041), across(-6.2e-3, 6.2e-3);
  int n_in_solid = 0, n_differ = 0;

  for (int i = 0; i < 20000; ++i) {
    const Vector<3> x = tip + Vector<3>(along(engine), across(engine), across(engine));
    n_in_solid += solid.contains(x) ? 1 : 0;
    n_differ += solid.contains(x) != mesh.contains(x) ? 1 : 0;
  }

  CHECK(n_in_solid > 5000);
  CHECK(n_differ < 30);
  CHECK(mesh.volume().value == Approx(exact_volume()).epsilon(2e-3));
}

TEST_CASE("particles hold the projectile's volume the better the finer they are")
{
  const auto solid = drawn();
  const auto error = [&](double spacing) {
    const components::ParticleLattice<3> lattice{{0, 0, 0}, spacing, 1};
    const int n = static_cast<int>(0.06 / spacing);
    const auto x = components::fill(solid, lattice, components::CellRange<3>{{0, 0, 0}, {n, n, n}});
    return std::abs(static_cast<double>(x.size()) * lattice.particle_volume() / exact_volume() - 1);
  };

  CHECK(error(0.97e-3) < 5e-2);
  CHECK(error(0.243e-3) < 5e-3);
}

}  // namespace test_projectile
