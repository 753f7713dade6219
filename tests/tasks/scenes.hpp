#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "components/geometry/ball.hpp"
#include "components/geometry/solid.hpp"
#include "tasks/scene.hpp"
#include "tasks/simulation.hpp"

/// Scenes made in code, and what a test reads from a simulation. SI units.
namespace tamp::test
{

using namespace tamp::tasks;

/// An empty scene on a grid that starts at 0; 1 cell along z makes no slab, `dimension` does. All faces are open.
inline Scene empty_scene(int dimension, runtime::Index n_cells, double cell_size)
{
  Scene scene;
  scene.name = scene.title = "test";
  scene.grid = {dimension, {0, 0, 0}, cell_size, n_cells};
  scene.n_patches = {1, 1, 1};
  for (auto& axis : scene.faces) axis = {components::OpenFace(), components::OpenFace()};
  scene.time.end = 1e30;
  return scene;
}

inline void add_walls(Scene& scene, std::size_t axis)
{
  scene.faces[axis] = {components::SymmetryFace(), components::SymmetryFace()};
}

/// Adds an elastic material of Young's modulus E and Poisson's ratio nu; returns its place.
inline int add_elastic(Scene& scene, double density, double E, double nu)
{
  const std::string name = "elastic " + std::to_string(scene.materials.size());
  scene.materials.push_back({name, density, components::Hypoelastic{E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))}});
  return static_cast<int>(scene.materials.size()) - 1;
}

/// K + 4G/3, the modulus of uniaxial strain.
inline double uniaxial_modulus(double E, double nu)
{
  return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
}

inline SceneBody& add_body(Scene& scene, int material, const AnySolid& solid, const Triple& velocity)
{
  SceneBody body{"body " + std::to_string(scene.bodies.size()), material, solid, velocity, 0};
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

inline SceneBody& add_box(Scene& scene, int material, const Triple& lower, const Triple& upper,
                          const Triple& velocity = {0, 0, 0})
{
  if (scene.grid.dimension == 2) {
    const components::Box<2> box{{lower[0], lower[1]}, {upper[0], upper[1]}};
    return add_body(scene, material, components::Solid<2>(box), velocity);
  }
  const components::Box<3> box{{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
  return add_body(scene, material, components::Solid<3>(box), velocity);
}

inline SceneBody& add_disk(Scene& scene, int material, double x, double y, double radius, const Triple& velocity)
{
  return add_body(scene, material, components::Solid<2>(components::Ball<2>{{x, y}, radius}), velocity);
}

/// One particle as the field file shows it; in plane strain z is 0, and stress is (xx, yy, zz, xy, yz, xz).
struct Particle {
  std::int64_t id;
  int material;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::array<double, 6> stress{};
  double density;
  double volume_ratio;
};

/// All particles in the order of their ids.
inline std::vector<Particle> particles_of(Simulation& simulation)
{
  std::vector<Particle> particles;
  const auto blocks = simulation.particle_columns();
  for (std::size_t g = 0; g < blocks.size(); ++g) {
    const runtime::ParticleBlock& block = blocks[g];
    const auto numbers = [&](const std::string& name) {
      const auto at = std::find_if(block.columns.begin(), block.columns.end(),
                                   [&](const runtime::Column& column) { return column.name == name; });
      return std::get<std::span<const double>>(at->values);
    };
    const auto id = std::get<std::span<const std::int64_t>>(block.columns.front().values);
    const auto position = numbers("position"), velocity = numbers("velocity"), stress = numbers("stress");
    const auto density = numbers("density"), J = numbers("J");
    const std::size_t dimension = static_cast<std::size_t>(simulation.scene().grid.dimension);
    const std::size_t n_stress = dimension == 2 ? 4 : 6;
    for (std::size_t p = 0; p < block.n; ++p) {
      Particle particle{.id = id[p], .material = static_cast<int>(g), .density = density[p], .volume_ratio = J[p]};
      std::copy_n(&position[p * dimension], dimension, particle.position.data());
      std::copy_n(&velocity[p * dimension], dimension, particle.velocity.data());
      std::copy_n(&stress[p * n_stress], n_stress, particle.stress.data());
      particles.push_back(particle);
    }
  }
  std::sort(particles.begin(), particles.end(), [](const Particle& a, const Particle& b) { return a.id < b.id; });
  return particles;
}

/// The numbers of a field of the first material.
inline std::vector<double> numbers_of(Simulation& simulation, const std::string& field)
{
  const auto blocks = simulation.particle_columns();
  const auto& columns = blocks[0].columns;
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == field; });
  REQUIRE(at != columns.end());
  const auto values = std::get<std::span<const double>>(at->values);
  return {values.begin(), values.end()};
}

inline void advance_to(Simulation& simulation, double end)
{
  while (simulation.time() < end) simulation.advance(end);
}

inline std::vector<Particle> particles_of_material(const std::vector<Particle>& particles, int material)
{
  std::vector<Particle> chosen;
  std::copy_if(particles.begin(), particles.end(), std::back_inserter(chosen),
               [material](const Particle& p) { return p.material == material; });
  return chosen;
}

/// Where the velocity along x passes `level` first, seen from the far end of x [m].
inline double front(std::vector<Particle> particles, double level)
{
  std::sort(particles.begin(), particles.end(),
            [](const Particle& a, const Particle& b) { return a.position[0] > b.position[0]; });
  for (std::size_t i = 1; i < particles.size(); ++i) {
    const double ahead = particles[i - 1].velocity[0] - level, here = particles[i].velocity[0] - level;
    if (ahead * here > 0) continue;
    const double part = ahead == here ? 0 : ahead / (ahead - here);
    return particles[i - 1].position[0] + part * (particles[i].position[0] - particles[i - 1].position[0]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

inline double total_mass(const ParticleReport& report)
{
  double mass = 0;
  for (const BodySums& body : report.bodies) mass += body.mass;
  return mass;
}

/// Energy that all work went to [J].
inline double worked(const EnergyLedger& energies)
{
  return energies.elastic + energies.plastic + energies.viscous + energies.contact;
}

/// How far the energy is off at any time until `end`, over what a scene without loads begins with.
inline double greatest_energy_error(const Scene& scene, double end)
{
  const auto simulation = Simulation::make(scene, 1);
  const double given = simulation->report().kinetic;
  double error = 0;
  while (simulation->time() < end) {
    simulation->advance(end);
    const EnergyLedger& e = simulation->energies();
    error = std::max(error, std::abs(simulation->report().kinetic + worked(e) + e.filter - e.half_step - given));
  }
  return error / given;
}

}  // namespace tamp::test
