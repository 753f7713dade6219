#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

/// The quick punch in plane strain beside the same as a slab one cell thick between smooth walls.
namespace test_slab
{

using namespace tamp;
using namespace tamp::test;

namespace
{

std::unique_ptr<Simulation> shipped_punch(const std::string& name)
{
  // Shorter than the bound in either: what the two take by themselves differs, as bounds count dimensions.
  const auto file = std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/punch" / name;
  return Simulation::make(tools::read_scene(file, {"/time/maximum_step=1e-6"}).scene, 1);
}

/// Particles of the slab by their partners in the plane, of which each has two, one behind the other.
std::vector<std::size_t> partners(const std::vector<Particle>& plane, const std::vector<Particle>& slab)
{
  std::vector<std::size_t> partner;
  partner.reserve(slab.size());
  for (const Particle& p : slab) {
    const auto is_same = [&](const Particle& q) {
      return q.material == p.material && (q.position - p.position).head<2>().norm() < 1e-9;
    };
    partner.push_back(static_cast<std::size_t>(std::find_if(plane.begin(), plane.end(), is_same) - plane.begin()));
  }
  return partner;
}

/// By material and id, so that a particle keeps its place in the list.
std::vector<Particle> sorted_particles(Simulation& simulation)
{
  std::vector<Particle> particles = particles_of(simulation);
  std::sort(particles.begin(), particles.end(), [](const Particle& a, const Particle& b) {
    return std::pair(a.material, a.id) < std::pair(b.material, b.id);
  });
  return particles;
}

}  // namespace

TEST_CASE("the quick punch as a slab one cell thick does over 100 equal steps what it does in the plane", "[scenes]")
{
  const auto plane = shipped_punch("quick.json"), slab = shipped_punch("slab.json");
  const std::vector<std::size_t> partner = partners(sorted_particles(*plane), sorted_particles(*slab));
  constexpr double thickness = 0.025, tolerance = 1e-10;

  for (int n = 0; n < n_steps_of(100); ++n) {
    plane->advance(1);
    slab->advance(1);
    REQUIRE(slab->last_step_size() == Approx(plane->last_step_size()).epsilon(tolerance));
    const double force = plane->grid_totals().impulse[1], of_slab = slab->grid_totals().impulse[1] / thickness;
    REQUIRE(of_slab == Approx(force).epsilon(1e-8));
  }

  const auto in_plane = sorted_particles(*plane), in_slab = sorted_particles(*slab);
  double highest_stress = 0;
  for (const Particle& p : in_plane) highest_stress = std::max(highest_stress, std::abs(p.stress[1]));
  REQUIRE(highest_stress > 1e7);
  for (std::size_t i = 0; i < in_slab.size(); ++i) {
    const Particle &a = in_plane[partner[i]], &b = in_slab[i];
    REQUIRE((a.position - b.position).head<2>().norm() < tolerance * thickness);
    REQUIRE((a.velocity - b.velocity).norm() < tolerance * 200);
    for (std::size_t k = 0; k < 6; ++k) REQUIRE(std::abs(a.stress[k] - b.stress[k]) < tolerance * highest_stress);
  }
}

}  // namespace test_slab
