#include "tools/bench/least_work.hpp"

namespace tamp::tools::bench
{

namespace
{

/// Operations for one particle that is no part of a rigid body, in so many dimensions, its stress left out.
double operations_of_transfers(int dimension)
{
  const double d = dimension, nodes_per_axis = 3;
  const double nodes = dimension == 2 ? 9 : 27, stress = dimension == 2 ? 4 : 6;
  // A weight is a quadratic function, its gradient a linear one.
  const double along_axes = d * nodes_per_axis * (4 + 2);
  const double products = nodes * ((d - 1) + d * (d - 1));
  // Mass, momentum and internal force.
  const double to_nodes = nodes * (1 + 2 * d + 2 * d * d);
  // Velocity, acceleration and the velocity's gradient.
  const double from_nodes = nodes * (4 * d + 2 * d * d);
  const double motion = 4 * d;
  // Deformation gradient and its determinant; stretch and rotation of the increment; strain turned and stress turned.
  const double kinematics = 2 * d * d * d + (dimension == 2 ? 3 : 14) + (dimension == 2 ? 20 : 120) + 8 * d * d * d;
  // Viscous pressure, wave speed and the bound on the step, energies.
  const double accounts = 20 + 2 * 2 * stress;
  return along_axes + products + to_nodes + from_nodes + motion + kinematics + accounts;
}

/// Operations of an elastic trial with its yield function: mean stress, stress deviator, their increments, sqrt(J2),
/// the limit.
double operations_of_substep(int dimension)
{
  const double stress = dimension == 2 ? 4 : 6;
  return 4 + 6 * stress + 10;
}

/// A number interpolated along both axes of a table, and the slope along one.
constexpr double operations_of_modulus = 14;

}  // namespace

LeastWork least_work(const tasks::Simulation& simulation, const components::UpdateCounts& before, long n_steps)
{
  const tasks::Scene& scene = simulation.scene();
  LeastWork sum;
  double particles = 0;
  for (int m = 0; m < static_cast<int>(scene.materials.size()); ++m) {
    const auto n = static_cast<double>(simulation.n_particles(m));
    sum.bytes += n * static_cast<double>(simulation.least_bytes_per_particle(m));
    particles += n;
  }
  double moved_by_grid = particles;
  for (const tasks::SceneBody& body : scene.bodies) {
    if (body.rigid) moved_by_grid -= static_cast<double>(body.n_particles);
  }
  const components::UpdateCounts& now = simulation.updates();
  const auto per_step = [&](std::size_t after, std::size_t at_start) {
    return static_cast<double>(after - at_start) / static_cast<double>(n_steps);
  };
  const int dimension = scene.grid.dimension;
  sum.operations = moved_by_grid * operations_of_transfers(dimension) +
                   per_step(now.substeps, before.substeps) * operations_of_substep(dimension) +
                   per_step(now.modulus_evaluations, before.modulus_evaluations) * operations_of_modulus;
  return {sum.bytes / particles, sum.operations / particles};
}

}  // namespace tamp::tools::bench
