#pragma once

#include <array>
#include <vector>

#include "components/materials/drucker_prager.hpp"

/// The program that TAMP is timed against: MLS-MPM as a textbook has it, on one thread, made to be quick and to do no
/// more than it must: no energies, no bound on the step, no contact, no checks, and stress rotated to first order.
namespace tamp::tools::bench
{

/// A particle as a whole in one place; SI units, tension positive.
template <int D>
struct PlainParticle {
  using Vector = std::array<double, D>;
  using Matrix = std::array<Vector, D>;

  Vector position, velocity;
  /// C_p, by which the velocity is v_p + C_p (x - x_p).
  Matrix affine_velocity;
  Matrix deformation_gradient;
  /// (xx, yy, zz, xy) in plane strain and (xx, yy, zz, xy, yz, xz) in space, as SymmetricTensor.
  std::array<double, n_symmetric<D>> stress;
  double mass;
  /// Volume at the start and now [m^3].
  double initial_volume, volume;
  components::SoilState state;
};

/// Soil above a smooth floor, the plane of the nodes 0 along the last axis, under gravity along it. APIC with quadratic
/// B-splines, of whose second moments D_p = h^2 / 4 the forces are made, too: -V sigma D_p^-1 (x_i - x_p) w_ip (Hu et
/// al., A moving least squares material point method, ACM Trans. Graph. 37, 2018); stress follows last in a step.
template <int D>
class PlainMlsMpm
{
 public:
  using Particle = PlainParticle<D>;
  using Stress = std::array<double, n_symmetric<D>>;

  struct Problem {
    double cell_size;
    /// Cells of the grid, whose lower end along the last axis is the floor. Particles stay a cell away from its other
    /// ends.
    std::array<int, D> n_cells;
    components::DruckerPrager soil;
    /// Gravity, downwards [m/s^2].
    double gravity;
  };

  /// Steps are fastest with particles in the order of the nodes, the last axis running fastest.
  PlainMlsMpm(const Problem& problem, std::vector<Particle> particles);

  /// Takes a step of this size [s], not bounded by anything.
  void step(double step_size);

  const std::vector<Particle>& particles() const { return particles_; }

 private:
  /// Momentum, later velocity, and mass of a node; four numbers in the plane, too, as many as a register holds.
  using Node = std::array<double, 4>;
  static constexpr std::size_t mass_at = D;
  static_assert(D == 2 || D == 3);

  /// The nodes that a particle reaches, 3 along each axis, and their weights.
  struct Stencil;
  /// Numbers of the yield surface, see DruckerPrager; `per_flow` is 1 / (G + alpha beta K).
  struct Cone {
    double alpha, k, beta, tension, per_flow;
  };

  Stencil stencil_of(const Particle& particle) const;
  void particles_to_grid(double step_size);
  void advance_nodes(double step_size);
  void grid_to_particles(double step_size);
  /// `g` is the velocity gradient times the step.
  void update_stress(Particle& particle, const typename Particle::Matrix& g) const;
  Stress returned(Stress trial, components::SoilState& state) const;

  Problem problem_;
  Cone cone_;
  /// Nodes along each axis: one layer lies below the grid's lower ends.
  std::array<std::size_t, D> n_nodes_;
  std::vector<Node> nodes_;
  std::vector<Particle> particles_;
};

}  // namespace tamp::tools::bench
