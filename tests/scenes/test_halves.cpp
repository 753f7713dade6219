#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_halves
{

/// Halves and quarters of symmetric scenes beside the whole: the same scene in a grid that ends at the plane.
using namespace tamp;
using namespace tamp::test;

namespace
{

using Assignments = std::vector<std::string>;

Scene scene_of(const std::string& file, Assignments changes, const Assignments& cut = {})
{
  changes.insert(changes.end(), cut.begin(), cut.end());
  return tools::read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs" / file, changes).scene;
}

/// A projectile that goes straight down into sand, on coarse cells: symmetric about x = 0.075 m and y = 0.05 m.
const Assignments straight_down{"/centrifuge=null",
                                "/gravity=[0,0,-196.2]",
                                "/grid/cell_size=0.0125",
                                "/grid/patches=[1,1,4]",
                                "/materials/projectile/particles_per_axis=14",
                                "/bodies/projectile/geometry/rotation/angle=270",
                                "/bodies/projectile/geometry/translation=[0.075,0.05,0.1085]",
                                "/bodies/projectile/nose=[0.075,0.05,0.1085]",
                                "/bodies/projectile/tail=[0.075,0.05,0.1495]",
                                "/bodies/projectile/velocity=[0,0,-283]"};

/// A projectile that goes down at 45 degrees within the plane y = 0.05 m, and turns there.
const Assignments inclined{"/centrifuge=null", "/gravity=[0,0,-196.2]", "/grid/cell_size=0.0125",
                           "/grid/patches=[1,1,4]", "/materials/projectile/particles_per_axis=14",
                           "/bodies/projectile/angular_velocity=[0,150,0]",
                           // Below their bound, which rounding changes where a particle only just reaches a node.
                           "/time/maximum_step=1.7e-6"};

/// The image of a particle's vector in the planes of symmetry that are normal to these axes.
Eigen::Vector3d image_of(Eigen::Vector3d v, const std::vector<int>& axes)
{
  for (const int axis : axes) v[axis] = -v[axis];
  return v;
}

/// Whole numbers that tell the sites of particles apart.
std::array<long, 3> site_of(const Eigen::Vector3d& x, double cell_size)
{
  std::array<long, 3> site;
  std::transform(x.begin(), x.end(), site.begin(), [&](double c) { return std::lround(c / cell_size * 1e4); });
  return site;
}

/// The whole and a part of it, step by step.
class Pair
{
 public:
  Pair(const Scene& whole, const Scene& part, std::vector<int> axes)
      : whole_(Simulation::make(whole, 1)), part_(Simulation::make(part, 1)), axes_(std::move(axes))
  {
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_plane = std::find(axes_.begin(), axes_.end(), axis) != axes_.end();
      twice_planes_[axis] = is_plane ? 2 * part.grid.lower[static_cast<std::size_t>(axis)] : 0;
    }
    std::map<std::array<long, 3>, std::size_t> places;
    const auto of_whole = particles_of(*whole_), of_part = particles_of(*part_);
    const double h = whole.grid.cell_size;
    for (std::size_t p = 0; p < of_whole.size(); ++p) places[site_of(of_whole[p].position, h)] = p;
    REQUIRE(of_whole.size() == of_part.size() << axes_.size());
    for (const Particle& p : of_part) {
      partners_.push_back(places.at(site_of(p.position, h)));
      images_.push_back(places.at(site_of(twice_planes_ + image_of(p.position, axes_), h)));
    }
  }

  void advance(int n_steps)
  {
    for (int n = 0; n < n_steps; ++n) {
      whole_->advance(1);
      part_->advance(1);
      // To within what rounding makes of the bound, where a particle only just reaches a node.
      REQUIRE(part_->time() == Approx(whole_->time()).epsilon(1e-10));
    }
  }
  void advance_to_end(double end)
  {
    advance_to(*whole_, end);
    advance_to(*part_, end);
  }

  /// The largest difference of a particle of the part from its partner and from the image of its image in the whole: of
  /// places over a cell, and of velocities over the largest.
  double difference()
  {
    const auto of_whole = particles_of(*whole_), of_part = particles_of(*part_);
    const double h = whole_->scene().grid.cell_size;
    double fastest = 0, apart = 0, unlike = 0;
    for (const Particle& p : of_whole) fastest = std::max(fastest, p.velocity.norm());
    for (std::size_t p = 0; p < of_part.size(); ++p) {
      const Particle &partner = of_whole[partners_[p]], &image = of_whole[images_[p]];
      const Eigen::Vector3d mirrored = twice_planes_ + image_of(image.position, axes_);
      apart =
          std::max({apart, (of_part[p].position - partner.position).norm(), (of_part[p].position - mirrored).norm()});
      unlike = std::max({unlike, (of_part[p].velocity - partner.velocity).norm(),
                         (of_part[p].velocity - image_of(image.velocity, axes_)).norm()});
    }
    return std::max(apart / h, unlike / fastest);
  }

  /// How far the first body has gone, and how much of the whole's way the part's is off.
  double error_of_depth() const
  {
    const auto way = [](Simulation& simulation) {
      const BodySums body = simulation.report().bodies[0];
      return Eigen::Vector3d((body.position - body.reference_position) / body.mass);
    };
    const int vertical = whole_->scene().grid.dimension - 1;
    const double of_whole = way(*whole_)[vertical], of_part = way(*part_)[vertical];
    return std::abs(of_part / of_whole - 1);
  }

  const Simulation& whole() const { return *whole_; }
  const Simulation& part() const { return *part_; }

 private:
  std::unique_ptr<Simulation> whole_, part_;
  std::vector<int> axes_;
  Eigen::Vector3d twice_planes_;
  std::vector<std::size_t> partners_, images_;
};

const Assignments half_of_punch{"/grid/lower=[0.5,0]", "/grid/patches=[1,2]"};

}  // namespace

TEST_CASE("half a punch goes as the whole does, in the same steps, whatever the method", "[scenes][slow]")
{
  const std::string rigid = GENERATE("false", "true");
  const auto [interpolator, transfer, timing, normal] =
      GENERATE(table<std::string, std::string, std::string, std::string>({
          {"cubic_spline", "flip", "usl", "regression"},
          {"gimp", "tflip", "usl", "regression"},
          {"gimp", "apic", "musl", "flatter"},
          {"cubic_spline", "tflip", "musl", "regression"},
      }));
  CAPTURE(rigid, interpolator, transfer, timing, normal);
  const Assignments method{"/interpolator=" + interpolator, "/transfer=" + transfer, "/stress_timing=" + timing,
                           "/contact/0/normal=" + normal, "/bodies/punch/rigid=" + rigid};
  Pair pair(scene_of("punch/quick.json", method), scene_of("punch/quick.json", method, half_of_punch), {0});

  pair.advance(n_steps_of(200));

  CHECK(pair.difference() < 1e-10);
  CHECK(pair.error_of_depth() < 1e-10);
}

TEST_CASE("half a rigid punch is as deep as the whole after a millisecond, in as many steps", "[scenes][slow]")
{
  const Assignments rigid{"/bodies/punch/rigid=true"};
  Pair pair(scene_of("punch/quick.json", rigid), scene_of("punch/half.json", {}), {0});

  pair.advance_to_end(end_of(1e-3));

  CHECK(pair.part().n_steps() == pair.whole().n_steps());
  CHECK(pair.error_of_depth() < 1e-4);
}

TEST_CASE("a quarter and a half of a projectile that goes straight down go as the whole does", "[scenes][slow]")
{
  const auto [interpolator, transfer, timing] = GENERATE(table<std::string, std::string, std::string>(
      {{"gimp", "tflip", "usl"}, {"quadratic_spline", "tflip", "musl"}, {"cubic_spline", "apic", "musl"}}));
  const auto [cut, axes] = GENERATE(table<std::string, std::vector<int>>(
      {{"/grid/lower=[0.075,0,0]", {0}}, {"/grid/lower=[0,0.05,0]", {1}}, {"/grid/lower=[0.075,0.05,0]", {0, 1}}}));
  CAPTURE(interpolator, cut);
  Assignments scene = straight_down;
  scene.insert(scene.end(), {"/interpolator=" + interpolator, "/transfer=" + transfer, "/stress_timing=" + timing});
  Pair pair(scene_of("uxo/quick.json", scene), scene_of("uxo/quick.json", scene, {cut}), axes);

  pair.advance(n_steps_of(200));

  CHECK(pair.difference() < 1e-10);
  CHECK(pair.error_of_depth() < 1e-10);
}

TEST_CASE("half an inclined projectile turns in its plane as the whole does", "[scenes][slow]")
{
  Pair pair(scene_of("uxo/quick.json", inclined), scene_of("uxo/quick.json", inclined, {"/grid/lower=[0,0.05,0]"}),
            {1});

  pair.advance(n_steps_of(200));

  CHECK(pair.difference() < 1e-10);
  CHECK(pair.error_of_depth() < 1e-10);
}

TEST_CASE("halves have the same digest on any threads", "[scenes][slow]")
{
  const std::string file = GENERATE("punch/half.json", "uxo/half.json");
  const Scene scene = scene_of(file, {});
  const auto digest = [&](int n_threads) {
    const auto simulation = Simulation::make(scene, n_threads);
    for (int n = 0; n < 12; ++n) simulation->advance(1);
    return simulation->digest();
  };

  CHECK(digest(2) == digest(1));
  CHECK(digest(3) == digest(1));
}

}  // namespace test_halves
