#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/loads/time_step.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/own_stiffness.hpp"
#include "components/shapes/transfer.hpp"
#include "tests/components/shapes/shape_reference.hpp"

namespace test_transfer
{

using namespace tamp;
using namespace tamp::components;
using namespace tamp::test;

namespace
{

constexpr double cell_size = 0.04;

/// Particles at random places with random states, and their transfer to the nodes by plain loops over all pairs.
template <int D>
struct Cloud {
  std::vector<Vector<D>> position, velocity;
  std::vector<double> mass, volume, viscous_pressure;
  std::vector<SymmetricTensor<D>> stress;

  Cloud(const GridBlock<D>& block, int n, std::mt19937& random)
  {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int p = 0; p < n; ++p) {
      position.push_back(random_place(block, random));
      velocity.push_back(Vector<D>::NullaryExpr([&] { return uniform(random); }));
      mass.push_back(2 + uniform(random));
      volume.push_back(0.5 + 0.1 * uniform(random));
      viscous_pressure.push_back(1 + uniform(random));
      stress.push_back(SymmetricTensor<D>::NullaryExpr([&] { return 5 * uniform(random); }));
    }
  }

  ParticleSources<D> sources() const { return {{position}, velocity, mass, volume, stress, viscous_pressure}; }
};

template <int D>
std::vector<double> inverse_masses(const std::vector<NodeSums<D>>& sums)
{
  std::vector<double> inverse;
  inverse.reserve(sums.size());
  for (const NodeSums<D>& node : sums) inverse.push_back(node.mass() > 0 ? 1 / node.mass() : 0);
  return inverse;
}

template <int D>
struct PlainSums {
  double mass = 0;
  Vector<D> momentum = Vector<D>::Zero();
  Vector<D> internal_force = Vector<D>::Zero();
  Vector<D> surface_gradient = Vector<D>::Zero();
};

/// Row and column of each stored component: (xx, yy, zz, xy) or (xx, yy, zz, xy, yz, xz).
template <int D>
double component(const SymmetricTensor<D>& a, int i, int j)
{
  constexpr int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  return a[place[i][j]];
}

template <int D>
PlainSums<D> plain_sums(const Cloud<D>& cloud, const Vector<D>& node, double l)
{
  PlainSums<D> sums;
  for (std::size_t p = 0; p < cloud.mass.size(); ++p) {
    const PlainShape<D> shape(cloud.position[p], node, l, cell_size);
    sums.mass += cloud.mass[p] * shape.weight;
    for (int i = 0; i < D; ++i) {
      sums.momentum[i] += cloud.mass[p] * cloud.velocity[p][i] * shape.weight;
      sums.surface_gradient[i] += cloud.volume[p] * shape.gradient[i];
      for (int j = 0; j < D; ++j) {
        const double stress = component<D>(cloud.stress[p], i, j) - (i == j ? cloud.viscous_pressure[p] : 0);
        sums.internal_force[i] -= cloud.volume[p] * stress * shape.gradient[j];
      }
    }
  }
  return sums;
}

template <int D>
std::vector<NodeMotion<D>> random_motion(std::ptrdiff_t n, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector<D>(Vector<D>::NullaryExpr([&] { return uniform(random); })); };
  std::vector<NodeMotion<D>> motion(static_cast<std::size_t>(n));
  for (NodeMotion<D>& node : motion) node.set(vector(), vector());
  return motion;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("with their velocity gradients, particles bring a linear velocity field to every node as it is",
                       "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(7);
  Cloud<D> cloud(block, 40, random);
  const Matrix<D> gradient =
      100 * Matrix<D>::NullaryExpr([&] { return std::uniform_real_distribution<double>(-1, 1)(random); });
  Vector<D> momentum = Vector<D>::Zero();
  for (std::size_t p = 0; p < cloud.mass.size(); ++p) {
    cloud.velocity[p] = cloud.velocity[0] + gradient * (cloud.position[p] - cloud.position[0]);
    momentum += cloud.mass[p] * cloud.velocity[p];
  }
  const std::vector<Matrix<D>> gradients(cloud.mass.size(), gradient);
  const Gimp<D> interpolator(n_per_axis);
  std::vector<NodeSums<D>> without(static_cast<std::size_t>(n_nodes_of(block))), with = without;
  ParticleSources<D> sources = cloud.sources();

  particles_to_grid(interpolator, block, sources, without.data());
  sources.carried_gradient = CarriedGradient::gradient;
  sources.carried = gradients;
  particles_to_grid<true, true>(interpolator, block, sources, with.data());

  double error_without = 0;
  const auto error_at = [&](std::size_t i, const NodeSums<D>& sums) {
    const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
    const Vector<D> expected = cloud.velocity[0] + gradient * (node - cloud.position[0]);
    return (sums.momentum() / sums.mass() - expected).norm();
  };
  for (std::size_t i = 0; i < with.size(); ++i) {
    momentum -= with[i].momentum();
    REQUIRE(with[i].mass() == without[i].mass());
    REQUIRE(with[i].internal_force() == without[i].internal_force());
    REQUIRE(with[i].surface_gradient() == without[i].surface_gradient());
    if (with[i].mass() < 1e-9) continue;
    REQUIRE(error_at(i, with[i]) < 1e-6);
    error_without = std::max(error_without, error_at(i, without[i]));
  }
  CHECK(error_without > 0.1);
  CHECK(momentum.norm() < 1e-11);
}

TEMPLATE_TEST_CASE_SIG("particles give the grid what plain loops over all pairs give", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(5);
  const Cloud<D> cloud(block, 60, random);
  std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));

  particles_to_grid(Gimp<D>(n_per_axis), block, cloud.sources(), sums.data());

  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
    const PlainSums<D> plain = plain_sums(cloud, node, 0.5 / n_per_axis);
    REQUIRE(sums[i].mass() == Approx(plain.mass).margin(1e-12));
    REQUIRE((sums[i].momentum() - plain.momentum).norm() < 1e-12);
    REQUIRE((sums[i].internal_force() - plain.internal_force).norm() * cell_size < 1e-11);
    REQUIRE((sums[i].surface_gradient() - plain.surface_gradient).norm() * cell_size < 1e-12);
  }
}

TEMPLATE_TEST_CASE_SIG("without surface gradients particles give the grid the rest to the last bit", "", ((int D), D),
                       2, 3)
{
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(12);
  const Cloud<D> cloud(block, 60, random);
  const auto interpolation = Interpolation<D>::make(Interpolator("gimp"), 2);
  std::vector<NodeSums<D>> with(static_cast<std::size_t>(n_nodes_of(block))), without = with;

  interpolation->particles_to_grid(block, cloud.sources(), true, with.data());
  interpolation->particles_to_grid(block, cloud.sources(), false, without.data());

  double greatest = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    greatest = std::max(greatest, with[i].surface_gradient().norm());
    REQUIRE(without[i].surface_gradient() == Vector<D>::Zero());
    with[i].set_surface_gradient(Vector<D>::Zero());
    REQUIRE((with[i].values == without[i].values).all());
  }
  CHECK(greatest > 0);
}

TEMPLATE_TEST_CASE_SIG("the grid receives all mass and momentum, and no net force", "", ((int D), D), 2, 3)
{
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(6);
  const Cloud<D> cloud(block, 200, random);
  std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));

  particles_to_grid(Gimp<D>(2), block, cloud.sources(), sums.data());

  double mass = 0;
  Vector<D> momentum = Vector<D>::Zero(), force = momentum;
  for (const NodeSums<D>& node : sums) {
    mass += node.mass();
    momentum += node.momentum();
    force += node.internal_force();
  }
  for (std::size_t p = 0; p < cloud.mass.size(); ++p) {
    mass -= cloud.mass[p];
    momentum -= cloud.mass[p] * cloud.velocity[p];
  }
  CHECK(std::abs(mass) < 1e-11);
  CHECK(momentum.norm() < 1e-11);
  CHECK(force.norm() * cell_size < 1e-11);
}

TEMPLATE_TEST_CASE_SIG("particles take from the grid what plain loops over all nodes give", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(7);
  const auto nodes = random_motion<D>(n_nodes_of(block), random);
  constexpr int n_samples = 50;
  std::vector<Vector<D>> position;
  position.reserve(n_samples);
  for (int sample = 0; sample < n_samples; ++sample) position.push_back(random_place(block, random));
  std::vector<ParticleMotion<D>> motions(position.size());

  grid_to_particles<Gimp<D>, D>(Gimp<D>(n_per_axis), n_per_axis, block, {position}, nodes.data(), {motions});

  for (std::size_t p = 0; p < position.size(); ++p) {
    const Vector<D>& x = position[p];
    const ParticleMotion<D>& motion = motions[p];
    Vector<D> velocity = Vector<D>::Zero(), change = velocity;
    Matrix<D> gradient = Matrix<D>::Zero();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const PlainShape<D> shape(x, node_position(block, static_cast<std::ptrdiff_t>(i)), 0.5 / n_per_axis, cell_size);
      for (int row = 0; row < D; ++row) {
        velocity[row] += shape.weight * nodes[i].velocity()[row];
        change[row] += shape.weight * nodes[i].velocity_change()[row];
        for (int column = 0; column < D; ++column) {
          gradient(row, column) += nodes[i].velocity()[row] * shape.gradient[column];
        }
      }
    }
    REQUIRE((motion.velocity - velocity).norm() < 1e-14);
    REQUIRE((motion.velocity_change - change).norm() < 1e-14);
    REQUIRE((motion.velocity_gradient - gradient).norm() * cell_size < 1e-13);
  }
}

TEMPLATE_TEST_CASE_SIG("vectors go to particles and back to the nodes as plain loops take them", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(13);
  const Cloud<D> cloud(block, 30, random);
  std::vector<NodeVector<D>> nodes(static_cast<std::size_t>(n_nodes_of(block))), sums = nodes;
  for (NodeVector<D>& node : nodes) {
    node.set(Vector<D>::NullaryExpr([&] { return std::uniform_real_distribution<double>(-1, 1)(random); }));
  }
  std::vector<Vector<D>> values(cloud.position.size());
  const auto interpolation = Interpolation<D>::make(Interpolator("gimp"), n_per_axis);

  interpolation->interpolate(block, {cloud.position}, nodes.data(), values);
  interpolation->add_vectors(block, {cloud.position}, cloud.velocity, sums.data());

  for (std::size_t p = 0; p < values.size(); ++p) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
      const double weight = PlainShape<D>(cloud.position[p], node, 0.5 / n_per_axis, cell_size).weight;
      values[p] -= weight * nodes[i].value();
      sums[i].set(sums[i].value() - weight * cloud.velocity[p]);
    }
    REQUIRE(values[p].norm() < 1e-14);
  }
  for (const NodeVector<D>& node : sums) REQUIRE(node.value().norm() < 1e-13);
}

TEMPLATE_TEST_CASE_SIG(
    "moments of weights and of velocities are those of plain loops, and give a linear field's gradient", "",
    ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(14);
  const Cloud<D> cloud(block, 30, random);
  auto nodes = random_motion<D>(n_nodes_of(block), random);
  std::vector<Matrix<D>> of_weights(cloud.position.size()), of_velocities = of_weights, of_linear = of_weights;
  std::vector<ParticleMotion<D>> motion(cloud.position.size());
  const auto interpolation = Interpolation<D>::make(Interpolator("gimp"), n_per_axis);

  interpolation->second_moments(block, {cloud.position}, of_weights);
  interpolation->grid_to_particles(block, {cloud.position}, nodes.data(), {motion, of_velocities});

  for (std::size_t p = 0; p < of_weights.size(); ++p) {
    Matrix<D> weights = Matrix<D>::Zero(), velocities = weights;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
      const Vector<D> arm = node - cloud.position[p];
      const double weight = PlainShape<D>(cloud.position[p], node, 0.5 / n_per_axis, cell_size).weight;
      weights += weight * arm * arm.transpose();
      velocities += weight * nodes[i].velocity() * arm.transpose();
    }
    REQUIRE((of_weights[p] - weights).norm() < 1e-14 * cell_size);
    REQUIRE((of_velocities[p] - velocities).norm() < 1e-13 * cell_size);
  }
  const Matrix<D> gradient = nodes[0].velocity() * nodes[1].velocity().transpose();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].set(gradient * node_position(block, static_cast<std::ptrdiff_t>(i)), Vector<D>::Zero());
  }
  interpolation->grid_to_particles(block, {cloud.position}, nodes.data(), {motion, of_linear});
  for (std::size_t p = 0; p < of_linear.size(); ++p) {
    REQUIRE((of_linear[p] * of_weights[p].inverse() - gradient).norm() < 1e-11);
  }
}

TEMPLATE_TEST_CASE_SIG("a particle's own stiffness is its share in that of its nodes", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const double l = 0.5 / n_per_axis;
  const auto block = block_of_nodes<D>(5, cell_size);
  std::mt19937 random(9);
  const Cloud<D> cloud(block, 60, random);
  std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));
  particles_to_grid(Gimp<D>(n_per_axis), block, cloud.sources(), sums.data());
  std::vector<double> stiffness(cloud.position.size());
  const std::vector<double> inverse_mass = inverse_masses(sums);
  const std::vector<NodeMotion<D>> nodes(sums.size());
  std::vector<ParticleMotion<D>> motion(stiffness.size());

  grid_to_particles<Gimp<D>, D>(Gimp<D>(n_per_axis), n_per_axis, block, {cloud.position}, nodes.data(),
                                {.motion = motion, .own_stiffness = {cloud.mass, inverse_mass.data(), stiffness}});

  for (std::size_t p = 0; p < cloud.mass.size(); ++p) {
    double plain = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
      const PlainShape<D> shape(cloud.position[p], node, l, cell_size);
      if (shape.weight > 0) plain += shape.gradient.squaredNorm() / sums[i].mass();
    }
    // Four an axis: two lie side by side across half a cell.
    plain *= cloud.mass[p] * cell_size * cell_size * (n_per_axis == 4 ? std::pow(2, D - 1) : 1);

    REQUIRE(stiffness[p] == Approx(plain));
  }
}

TEMPLATE_TEST_CASE_SIG("no place of a particle alone is stiffer than the greatest own stiffness", "", ((int D), D), 2,
                       3)
{
  const int n_per_axis = GENERATE(1, 2, 3, 4);
  const auto block = block_of_nodes<D>(6, 1.0);
  const Gimp<D> interpolator = GENERATE_COPY(Gimp<D>(n_per_axis), Gimp<D>::quadratic_spline());
  const double greatest = greatest_own_stiffness(D, n_per_axis, interpolator.greatest_stiffness_along_axis());
  const double l = interpolator.half_size();
  const auto alone = [&](double along_each_axis) {
    const Vector<D> x = block.origin + Vector<D>::Constant(2 + along_each_axis);
    std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));
    const std::vector<Vector<D>> position{x}, velocity{Vector<D>::Zero()};
    const std::vector<double> one{1};
    const std::vector<SymmetricTensor<D>> stress{SymmetricTensor<D>::Zero()};
    particles_to_grid(interpolator, block, {{position}, velocity, one, one, stress, one}, sums.data());
    const std::vector<double> inverse_mass = inverse_masses(sums);
    const std::vector<NodeMotion<D>> nodes(sums.size());
    std::vector<ParticleMotion<D>> motion(1);
    std::vector<double> stiffness(1);
    grid_to_particles<Gimp<D>, D>(interpolator, n_per_axis, block, {position}, nodes.data(),
                                  {.motion = motion, .own_stiffness = {one, inverse_mass.data(), stiffness}});
    return stiffness[0];
  };

  for (int i = 0; i < 200; ++i) REQUIRE(alone((i + 0.5) / 200) <= greatest * (1 + 1e-9));
  // It just reaches the node behind.
  CHECK(alone(l - 1e-6) == Approx(greatest).epsilon(1e-4));
}

}  // namespace test_transfer
