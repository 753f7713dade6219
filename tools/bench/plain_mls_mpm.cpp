#include "tools/bench/plain_mls_mpm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace tamp::tools::bench
{

namespace
{

/// Both axes of each shear, in the order of SymmetricTensor; a plane has the first alone.
constexpr std::array<std::array<std::size_t, 2>, 3> shear_axes{{{0, 1}, {1, 2}, {0, 2}}};

template <int D>
using Matrix = typename PlainParticle<D>::Matrix;

template <int D>
constexpr std::size_t n_shears = n_symmetric<D> - 3;

template <int D>
Matrix<D> matrix_of(const std::array<double, n_symmetric<D>>& tensor)
{
  Matrix<D> a;
  for (std::size_t k = 0; k < D; ++k) a[k][k] = tensor[k];
  for (std::size_t s = 0; s < n_shears<D>; ++s) {
    const auto [i, j] = shear_axes[s];
    a[i][j] = a[j][i] = tensor[3 + s];
  }
  return a;
}

double determinant(const Matrix<2>& a)
{
  return a[0][0] * a[1][1] - a[0][1] * a[1][0];
}

double determinant(const Matrix<3>& a)
{
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

}  // namespace

template <int D>
struct PlainMlsMpm<D>::Stencil {
  std::size_t first;
  /// Vector from the particle to the first node [m].
  typename Particle::Vector offset;
  std::array<std::array<double, 3>, D> weights;
};

template <int D>
PlainMlsMpm<D>::PlainMlsMpm(const Problem& problem, std::vector<Particle> particles)
    : problem_(problem), particles_(std::move(particles))
{
  const components::DruckerPrager& soil = problem.soil;
  const auto slope_of = [](double angle) {
    const double sine = std::sin(angle * std::numbers::pi / 180);
    return 2 * std::numbers::sqrt3 * sine / (3 - sine);
  };
  const double friction = soil.friction_angle * std::numbers::pi / 180;
  cone_.alpha = slope_of(soil.friction_angle);
  cone_.beta = slope_of(soil.dilation_angle);
  cone_.k = soil.cohesion * 2 * std::numbers::sqrt3 * std::cos(friction) / (3 - std::sin(friction));
  const double apex = cone_.alpha > 0 ? cone_.k / cone_.alpha : std::numeric_limits<double>::infinity();
  cone_.tension = std::min(soil.tension_cutoff, apex);

  cone_.per_flow = 1 / (soil.shear_modulus + cone_.alpha * cone_.beta * soil.bulk_modulus);

  std::size_t n = 1;
  for (std::size_t k = 0; k < D; ++k) {
    n_nodes_[k] = static_cast<std::size_t>(problem.n_cells[k]) + 3;
    n *= n_nodes_[k];
  }
  nodes_.resize(n);
}

template <int D>
void PlainMlsMpm<D>::step(double step_size)
{
  particles_to_grid(step_size);
  advance_nodes(step_size);
  grid_to_particles(step_size);
}

template <int D>
typename PlainMlsMpm<D>::Stencil PlainMlsMpm<D>::stencil_of(const Particle& particle) const
{
  const double h = problem_.cell_size, per_cell = 1 / h;
  Stencil stencil{};
  for (std::size_t k = 0; k < D; ++k) {
    // The nearest node is the middle one of three. As layers count from one below the grid, its number is that of the
    // first of the three.
    const double x = particle.position[k] * per_cell;
    const double beyond_middle_of_cell = x + 0.5;
    const int middle = static_cast<int>(beyond_middle_of_cell);
    const double d = x - middle;
    stencil.weights[k] = {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)};
    stencil.offset[k] = (-1 - d) * h;
    stencil.first = stencil.first * n_nodes_[k] + static_cast<std::size_t>(middle);
  }
  return stencil;
}

template <int D>
void PlainMlsMpm<D>::particles_to_grid(double step_size)
{
  std::ranges::fill(nodes_, Node{});
  const double h = problem_.cell_size;
  const double impulse = -4 * step_size / (h * h);
  for (const Particle& p : particles_) {
    const Stencil stencil = stencil_of(p);
    const Matrix<D> stress = matrix_of<D>(p.stress);
    // `given` is what the first node gets; from node to node along an axis it changes by that axis' `slope`.
    std::array<Node, D> slope{};
    Node given{};
    given[mass_at] = p.mass;
    for (std::size_t i = 0; i < D; ++i) {
      given[i] = p.mass * p.velocity[i];
      for (std::size_t j = 0; j < D; ++j) {
        const double affine = impulse * p.volume * stress[i][j] + p.mass * p.affine_velocity[i][j];
        given[i] += affine * stencil.offset[j];
        slope[j][i] = affine * h;
      }
    }
    const auto give_row = [&](std::size_t first, double weight, Node value) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double w = weight * stencil.weights[D - 1][c];
        Node& node = nodes_[first + c];
        for (std::size_t k = 0; k < 4; ++k) node[k] += w * value[k];
        for (std::size_t k = 0; k < 4; ++k) value[k] += slope[D - 1][k];
      }
    };
    for (std::size_t a = 0; a < 3; ++a) {
      if constexpr (D == 2) {
        give_row(stencil.first + a * n_nodes_[1], stencil.weights[0][a], given);
      } else {
        Node value = given;
        for (std::size_t b = 0; b < 3; ++b) {
          give_row(stencil.first + (a * n_nodes_[1] + b) * n_nodes_[2], stencil.weights[0][a] * stencil.weights[1][b],
                   value);
          for (std::size_t k = 0; k < 4; ++k) value[k] += slope[1][k];
        }
      }
      for (std::size_t k = 0; k < 4; ++k) given[k] += slope[0][k];
    }
  }
}

/// Below the floor is the mirror image of what is above: the layer under it, 0, reflects the one over it, 2.
template <int D>
void PlainMlsMpm<D>::advance_nodes(double step_size)
{
  const double fall = -problem_.gravity * step_size;
  const std::size_t n_up = n_nodes_[D - 1];
  for (std::size_t first = 0; first < nodes_.size(); first += n_up) {
    const auto column = std::span(nodes_).subspan(first, n_up);
    column[0][D - 1] = -column[0][D - 1];
    for (std::size_t k = 0; k < 4; ++k) column[2][k] += column[0][k];
    for (Node& node : column.subspan(1)) {
      if (node[mass_at] == 0) continue;
      const double per_mass = 1 / node[mass_at];
      for (std::size_t k = 0; k < D; ++k) node[k] *= per_mass;
      node[D - 1] += fall;
    }
    column[1][D - 1] = 0;
    column[0] = column[2];
    column[0][D - 1] = -column[0][D - 1];
  }
}

/// Flattened, as a particle's numbers would otherwise go through memory.
template <int D>
[[gnu::flatten]] void PlainMlsMpm<D>::grid_to_particles(double step_size)
{
  const double h = problem_.cell_size, inverse_moment = 4 / (h * h);
  for (Particle& p : particles_) {
    const Stencil stencil = stencil_of(p);
    // Sums of w v and, for each axis, of w v times how many cells the node lies beyond the first: 0 to 2.
    Node sum{};
    std::array<Node, D> moment{};
    const auto take_row = [&](std::size_t first, double weight, Node& row_sum) {
      Node row{}, row_moment{};
      for (std::size_t c = 0; c < 3; ++c) {
        const double w = stencil.weights[D - 1][c];
        const Node& node = nodes_[first + c];
        for (std::size_t k = 0; k < 4; ++k) row[k] += w * node[k];
        for (std::size_t k = 0; k < 4; ++k) row_moment[k] += static_cast<double>(c) * w * node[k];
      }
      for (std::size_t k = 0; k < 4; ++k) row_sum[k] += weight * row[k];
      for (std::size_t k = 0; k < 4; ++k) moment[D - 1][k] += weight * row_moment[k];
    };
    for (std::size_t a = 0; a < 3; ++a) {
      Node layer{};
      if constexpr (D == 2) {
        take_row(stencil.first + a * n_nodes_[1], stencil.weights[0][a], layer);
      } else {
        for (std::size_t b = 0; b < 3; ++b) {
          Node row{};
          take_row(stencil.first + (a * n_nodes_[1] + b) * n_nodes_[2], stencil.weights[0][a] * stencil.weights[1][b],
                   row);
          for (std::size_t k = 0; k < 4; ++k) layer[k] += row[k];
          for (std::size_t k = 0; k < 4; ++k) moment[1][k] += static_cast<double>(b) * row[k];
        }
      }
      for (std::size_t k = 0; k < 4; ++k) sum[k] += layer[k];
      for (std::size_t k = 0; k < 4; ++k) moment[0][k] += static_cast<double>(a) * layer[k];
    }
    Matrix<D> g;
    for (std::size_t i = 0; i < D; ++i) {
      p.velocity[i] = sum[i];
      p.position[i] += step_size * sum[i];
      for (std::size_t j = 0; j < D; ++j) {
        const double affine = inverse_moment * (moment[j][i] * h + sum[i] * stencil.offset[j]);
        p.affine_velocity[i][j] = affine;
        g[i][j] = step_size * affine;
      }
    }
    update_stress(p, g);
  }
}

template <int D>
void PlainMlsMpm<D>::update_stress(Particle& p, const Matrix<D>& g) const
{
  Matrix<D> gradient = p.deformation_gradient;
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t j = 0; j < D; ++j) {
      for (std::size_t k = 0; k < D; ++k) gradient[i][j] += g[i][k] * p.deformation_gradient[k][j];
    }
  }
  p.deformation_gradient = gradient;
  p.volume = p.initial_volume * determinant(gradient);

  // Jaumann's rate of stress: to the elastic increment come W sigma and its transpose.
  const Matrix<D> old = matrix_of<D>(p.stress);
  Matrix<D> turned{};
  double expansion = 0;
  for (std::size_t i = 0; i < D; ++i) {
    expansion += g[i][i];
    for (std::size_t j = 0; j < D; ++j) {
      for (std::size_t k = 0; k < D; ++k) turned[i][j] += 0.5 * (g[i][k] - g[k][i]) * old[k][j];
    }
  }
  const double G = problem_.soil.shear_modulus;
  const double swelling = (problem_.soil.bulk_modulus - 2 * G / 3) * expansion;
  Stress trial = p.stress;
  for (std::size_t k = 0; k < 3; ++k) trial[k] += swelling;
  for (std::size_t k = 0; k < D; ++k) trial[k] += 2 * G * g[k][k] + 2 * turned[k][k];
  for (std::size_t s = 0; s < n_shears<D>; ++s) {
    const auto [i, j] = shear_axes[s];
    trial[3 + s] += G * (g[i][j] + g[j][i]) + turned[i][j] + turned[j][i];
  }
  p.stress = returned(trial, p.state);
}

template <int D>
typename PlainMlsMpm<D>::Stress PlainMlsMpm<D>::returned(Stress stress, components::SoilState& state) const
{
  const double K = problem_.soil.bulk_modulus, G = problem_.soil.shear_modulus;
  const double trial_pressure = -(stress[0] + stress[1] + stress[2]) * (1.0 / 3);
  double j2 = 0;
  for (std::size_t k = 0; k < 3; ++k) j2 += 0.5 * (stress[k] + trial_pressure) * (stress[k] + trial_pressure);
  for (std::size_t k = 3; k < n_symmetric<D>; ++k) j2 += stress[k] * stress[k];
  const double strength = cone_.k + cone_.alpha * trial_pressure, cut_off = -cone_.tension;
  if (trial_pressure >= cut_off && j2 <= strength * strength) return stress;

  const double tau = std::sqrt(j2);
  double plastic_shear = (tau - strength) * cone_.per_flow;
  double plastic_expansion = cone_.beta * plastic_shear;
  double sqrt_j2 = std::max(tau - G * plastic_shear, 0.0);
  double pressure = trial_pressure + K * plastic_expansion;
  if (plastic_shear <= 0 || pressure < cut_off) {
    pressure = cut_off;
    sqrt_j2 = std::min(tau, std::max(cone_.k + cone_.alpha * cut_off, 0.0));
    plastic_shear = (tau - sqrt_j2) / G;
    plastic_expansion = (cut_off - trial_pressure) / K;
  }
  state.plastic_volumetric -= plastic_expansion;
  state.equivalent_plastic += plastic_shear * (1 / std::numbers::sqrt3);
  const double kept = tau > 0 ? sqrt_j2 / tau : 1;
  for (std::size_t k = 0; k < 3; ++k) stress[k] = kept * (stress[k] + trial_pressure) - pressure;
  for (std::size_t k = 3; k < n_symmetric<D>; ++k) stress[k] *= kept;
  return stress;
}

template class PlainMlsMpm<2>;
template class PlainMlsMpm<3>;

}  // namespace tamp::tools::bench
