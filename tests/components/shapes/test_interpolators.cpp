#include <catch2/catch.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "components/loads/time_step.hpp"
#include "components/shapes/dense_transfer.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/interpolator.hpp"
#include "components/shapes/transfer.hpp"
#include "tests/components/shapes/shape_reference.hpp"

namespace test_interpolators
{

using namespace tamp;
using namespace tamp::components;
using namespace tamp::test;

namespace
{

constexpr double cell_size = 0.04;

std::vector<Interpolator> all_interpolators()
{
  std::vector<Interpolator> all;
  for (const auto& word : Interpolator::words()) all.push_back(word.value);
  return all;
}

/// Weight and gradient [1/m].
template <int D>
struct NodeShape {
  double weight = 0;
  Vector<D> gradient = Vector<D>::Zero();
};

/// A particle's weight and gradient at each node, seen through the kernels: its mass is 1, and a stress of -1 Pa along
/// one axis on a volume of 1 makes the force along it that component of the gradient.
template <int D>
std::vector<NodeShape<D>> shape_of(Interpolator interpolator, int n_per_axis, const GridBlock<D>& block,
                                   const Vector<D>& x, const Matrix<D>& f)
{
  const auto interpolation = Interpolation<D>::make(interpolator, n_per_axis);
  const std::vector<Vector<D>> position{x}, velocity{Vector<D>::Zero()};
  const std::vector<Matrix<D>> deformation{f};
  const std::vector<double> one{1}, none{0};
  std::vector<SymmetricTensor<D>> stress{SymmetricTensor<D>::Zero()};
  for (int k = 0; k < D; ++k) stress[0][k] = -1;
  std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));
  interpolation->particles_to_grid(block, {{position, deformation}, velocity, one, one, stress, none}, true,
                                   sums.data());
  std::vector<NodeShape<D>> shape(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    shape[i] = {sums[i].mass(), sums[i].internal_force()};
    REQUIRE((sums[i].surface_gradient() - shape[i].gradient).norm() * cell_size < 1e-14);
  }
  return shape;
}

/// A deformation of up to `most` in every entry.
template <int D>
Matrix<D> random_deformation(double most, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-most, most);
  return Matrix<D>::Identity() + Matrix<D>::NullaryExpr([&] { return uniform(random); });
}

/// The multilinear function of the node at `node`, in cells.
template <int D>
double hats(const Vector<D>& x, const Vector<D>& node)
{
  double product = 1;
  for (int k = 0; k < D; ++k) product *= hat(x[k] - node[k]);
  return product;
}

/// The published weights of CPDI: means over the corners, and gradients by Gauss's theorem over the sides in the plane
/// (Sadeghirad, Brannon & Burghardt 2011, eqs 19 to 21). Lengths in cells.
NodeShape<2> published_cpdi(const Vector<2>& x, const Matrix<2>& half_edges, const Vector<2>& node)
{
  const Vector<2> r1 = half_edges.col(0), r2 = half_edges.col(1);
  const std::array<Vector<2>, 4> corners{x - r1 - r2, x + r1 - r2, x + r1 + r2, x - r1 + r2};
  NodeShape<2> shape;
  double doubled_area = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const Vector<2>&a = corners[c], &b = corners[(c + 1) % 4];
    doubled_area += a[0] * b[1] - a[1] * b[0];
    shape.weight += 0.25 * hats<2>(a, node);
    // Counterclockwise: (dy, -dx) is the outward normal times the length.
    shape.gradient += 0.5 * (hats<2>(a, node) + hats<2>(b, node)) * Vector<2>(b[1] - a[1], a[0] - b[0]);
  }
  shape.gradient /= 0.5 * doubled_area;
  return shape;
}

/// The cubic B-spline: the mean of the hat over a cell, averaged over a cell again; by a sum over many places.
double smoothed_hat(double x)
{
  constexpr int n = 4000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += mean_of_hat(x - 0.5 + (i + 0.5) / n, 0.5);
  return sum / n;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("any interpolator takes linear fields to deformed particles as they are", "", ((int D), D), 2, 3)
{
  const Interpolator interpolator = GENERATE(from_range(all_interpolators()));
  const int n_per_axis = GENERATE(1, 2, 3);
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(1);
  for (int sample = 0; sample < 60; ++sample) {
    const Vector<D> x = random_place(block, random);
    const auto shape = shape_of<D>(interpolator, n_per_axis, block, x, random_deformation<D>(0.3, random));

    double sum = -1;
    Vector<D> place = -x, gradient = Vector<D>::Zero();
    Matrix<D> gradient_of_place = -Matrix<D>::Identity();
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
      sum += shape[i].weight;
      place += shape[i].weight * node;
      gradient += shape[i].gradient;
      gradient_of_place += node * shape[i].gradient.transpose();
      REQUIRE(shape[i].weight >= 0);
    }

    REQUIRE(std::abs(sum) < 1e-14);
    REQUIRE(place.norm() < 1e-14);
    REQUIRE(gradient.norm() * cell_size < 2e-14);
    REQUIRE(gradient_of_place.norm() < 1e-13);
  }
}

TEST_CASE("a particle on the face of its patch reaches no nodes but those of the patch and one layer more")
{
  const Interpolator interpolator = GENERATE(from_range(all_interpolators()));
  const double h = GENERATE(0.1, 0.07, 0.3), lower = GENERATE(0.0, -0.7);
  constexpr int n_cells = 3;
  for (int face = 1; face < 40; ++face) {
    const double x = lower + h * face;
    // As the runtime tells the cell of a particle; its patch begins or ends there.
    const int cell = static_cast<int>(std::floor((x - lower) / h));
    for (const int first : {cell, cell - n_cells + 1}) {
      GridBlock<2> block{{lower + h * (first - 1), 0}, h, {n_cells + 3, n_cells + 3}, {1, n_cells + 3}};
      const auto shape = shape_of<2>(interpolator, 2, block, {x, 2.3 * h}, Matrix<2>::Identity());

      double sum = 0, place = 0;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        sum += shape[i].weight;
        place += shape[i].weight * node_position(block, static_cast<std::ptrdiff_t>(i)).x();
      }
      INFO("face " << face << " at " << x << ", patch from cell " << first);
      REQUIRE(sum == Approx(1).epsilon(1e-14));
      REQUIRE(place == Approx(x).margin(1e-13));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("cpGIMP averages over a box as long as the particle is stretched", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 4);
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> stretch(0.1, 1.9);
  for (int sample = 0; sample < 60; ++sample) {
    const Vector<D> x = random_place(block, random),
                    stretches = Vector<D>::NullaryExpr([&] { return stretch(random); });

    const auto shape = shape_of<D>(Interpolator("cpgimp"), n_per_axis, block, x, stretches.asDiagonal());

    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<D> away = (x - node_position(block, static_cast<std::ptrdiff_t>(i))) / cell_size;
      double weight = 1;
      Vector<D> gradient = Vector<D>::Ones();
      for (int k = 0; k < D; ++k) {
        const double l = stretches[k] * 0.5 / n_per_axis;
        weight *= mean_of_hat(away[k], l);
        for (int other = 0; other < D; ++other) {
          gradient[other] *= other == k ? mean_slope_of_hat(away[k], l) : mean_of_hat(away[k], l);
        }
      }
      REQUIRE(shape[i].weight == Approx(weight).margin(2e-15));
      REQUIRE((shape[i].gradient * cell_size - gradient).norm() < 2e-14);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("a particle that is only turned has the weights of GIMP under cpGIMP", "", ((int D), D), 2, 3)
{
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(3);
  const Vector<D> x = random_place(block, random);
  Matrix<D> turn = Matrix<D>::Identity();
  turn.template topLeftCorner<2, 2>() << 0.6, -0.8, 0.8, 0.6;

  const auto gimp = shape_of<D>(Interpolator("gimp"), 2, block, x, turn);
  const auto cpgimp = shape_of<D>(Interpolator("cpgimp"), 2, block, x, turn);

  for (std::size_t i = 0; i < gimp.size(); ++i) {
    REQUIRE(cpgimp[i].weight == Approx(gimp[i].weight).margin(1e-15));
    REQUIRE((cpgimp[i].gradient - gimp[i].gradient).norm() * cell_size < 1e-14);
  }
}

TEST_CASE("CPDI has its published weights in the plane")
{
  const int n_per_axis = GENERATE(1, 2);
  const auto block = block_of_nodes<2>(6, cell_size);
  std::mt19937 random(4);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector<2> x = random_place(block, random);
    const Matrix<2> f = random_deformation<2>(0.3, random);

    const auto shape = shape_of<2>(Interpolator("cpdi"), n_per_axis, block, x, f);

    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<2> node = node_position(block, static_cast<std::ptrdiff_t>(i)) / cell_size;
      const auto published = published_cpdi(x / cell_size, 0.5 / n_per_axis * f, node);
      REQUIRE(shape[i].weight == Approx(published.weight).margin(1e-14));
      REQUIRE((shape[i].gradient * cell_size - published.gradient).norm() < 1e-13);
    }
  }
}

TEST_CASE(
    "CPDI in space has the means of the functions at the corners, and the mean gradient of what is linear between")
{
  const auto block = block_of_nodes<3>(6, cell_size);
  std::mt19937 random(5);
  for (int sample = 0; sample < 20; ++sample) {
    const Vector<3> x = random_place(block, random);
    const Matrix<3> f = random_deformation<3>(0.25, random), edges = 0.25 * f;

    const auto shape = shape_of<3>(Interpolator("cpdi"), 2, block, x, f);

    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<3> node = node_position(block, static_cast<std::ptrdiff_t>(i)) / cell_size;
      const auto at_corner = [&](double a, double b, double c) {
        return hats<3>(x / cell_size + edges * Vector<3>(a, b, c), node);
      };
      double weight = 0;
      Vector<3> slopes = Vector<3>::Zero();
      for (const double a : {-1, 1}) {
        for (const double b : {-1, 1}) {
          weight += (at_corner(a, b, -1) + at_corner(a, b, 1)) / 8;
          // From side to side of the particle, which is 2 long in its own axes.
          slopes += Vector<3>(at_corner(1, a, b) - at_corner(-1, a, b), at_corner(a, 1, b) - at_corner(a, -1, b),
                              at_corner(a, b, 1) - at_corner(a, b, -1)) /
                    8;
        }
      }
      REQUIRE(shape[i].weight == Approx(weight).margin(1e-14));
      REQUIRE((edges.transpose() * shape[i].gradient * cell_size - slopes).norm() < 1e-13);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("what is stretched beyond a cell reaches no further than one layer of nodes", "", ((int D), D),
                       2, 3)
{
  const Interpolator interpolator = GENERATE(Interpolator("cpgimp"), Interpolator("cpdi"));
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(6);
  for (int sample = 0; sample < 40; ++sample) {
    const Vector<D> x = random_place(block, random);
    const Matrix<D> f = 8 * random_deformation<D>(0.3, random);

    const auto shape = shape_of<D>(interpolator, 2, block, x, f);

    Vector<D> place = -x;
    Matrix<D> gradient_of_place = -Matrix<D>::Identity();
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<D> node = node_position(block, static_cast<std::ptrdiff_t>(i));
      if (((x - node).array().abs() > 2 * cell_size).any()) REQUIRE(shape[i].weight == 0);
      place += shape[i].weight * node;
      gradient_of_place += node * shape[i].gradient.transpose();
    }
    REQUIRE(place.norm() < 1e-14);
    REQUIRE(gradient_of_place.norm() < 1e-13);
  }
}

TEST_CASE("cubic splines are the mean over a cell of quadratic ones")
{
  const auto block = block_of_nodes<2>(6, cell_size);
  std::mt19937 random(7);
  for (int sample = 0; sample < 20; ++sample) {
    const Vector<2> x = random_place(block, random);

    const auto shape = shape_of<2>(Interpolator("cubic_spline"), 2, block, x, Matrix<2>::Identity());

    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Vector<2> away = (x - node_position(block, static_cast<std::ptrdiff_t>(i))) / cell_size;
      const double across = smoothed_hat(away[1]);
      REQUIRE(shape[i].weight == Approx(smoothed_hat(away[0]) * across).margin(1e-7));
      // The slope of a mean over a cell is the difference between its ends.
      const double slope = mean_of_hat(away[0] + 0.5, 0.5) - mean_of_hat(away[0] - 0.5, 0.5);
      REQUIRE(shape[i].gradient[0] * cell_size == Approx(slope * across).margin(1e-7));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("no place of a particle alone is stiffer than its interpolator's greatest", "", ((int D), D), 2,
                       3)
{
  const Interpolator interpolator = GENERATE(Interpolator("gimp"), Interpolator("cpgimp"), Interpolator("cpdi"),
                                             Interpolator("quadratic_spline"), Interpolator("cubic_spline"));
  const int n_per_axis = GENERATE(1, 2, 3, 4);
  const auto block = block_of_nodes<D>(7, 1.0);
  const auto interpolation = Interpolation<D>::make(interpolator, n_per_axis);
  const auto alone = [&](double along_each_axis) {
    const std::vector<Vector<D>> position{block.origin + Vector<D>::Constant(2 + along_each_axis)};
    const std::vector<Matrix<D>> undeformed{Matrix<D>::Identity()};
    const std::vector<double> one{1};
    const auto shape = shape_of<D>(interpolator, n_per_axis, block, position[0], undeformed[0]);
    const std::vector<NodeMotion<D>> nodes(shape.size());
    std::vector<ParticleMotion<D>> motion(1);
    std::vector<double> inverse_mass, stiffness(1);
    for (const NodeShape<D>& node : shape) inverse_mass.push_back(node.weight > 1e-24 ? 1 / node.weight : 0);
    interpolation->grid_to_particles(block, {position, undeformed}, nodes.data(),
                                     {.motion = motion, .own_stiffness = {one, inverse_mass.data(), stiffness}});
    return stiffness[0];
  };

  double greatest = 0;
  for (int i = 0; i < 200; ++i) greatest = std::max(greatest, alone((i + 0.5) / 200));

  CHECK(greatest <= interpolation->greatest_own_stiffness() * (1 + 1e-9));
  CHECK(greatest >= 0.9 * interpolation->greatest_own_stiffness());
}

TEMPLATE_TEST_CASE_SIG("dense stencils take from the grid what they give to it", "", ((int D), D), 2, 3)
{
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any_vector = [&] { return Vector<D>(Vector<D>::NullaryExpr([&] { return uniform(random); })); };
  std::vector<NodeMotion<D>> nodes(static_cast<std::size_t>(n_nodes_of(block)));
  for (NodeMotion<D>& node : nodes) node.set(any_vector(), any_vector());
  const std::vector<Vector<D>> position{random_place(block, random)}, force{any_vector()}, at_rest{Vector<D>::Zero()};
  const std::vector<Matrix<D>> deformation{random_deformation<D>(0.3, random)},
      gradient{random_deformation<D>(3, random)};
  const std::vector<double> mass{1.7}, none{0};
  const std::vector<SymmetricTensor<D>> no_stress{SymmetricTensor<D>::Zero()};
  const auto interpolation = Interpolation<D>::make(Interpolator("cpdi"), 2);
  const auto shape = shape_of<D>(Interpolator("cpdi"), 2, block, position[0], deformation[0]);
  std::vector<ParticleMotion<D>> motion(1);
  std::vector<NodeVector<D>> of_forces(nodes.size());
  std::vector<NodeSums<D>> of_gradients(nodes.size());
  std::vector<Matrix<D>> first_moments(1), second_moments(1);
  const ParticlePlaces<D> places{position, deformation};

  interpolation->second_moments(block, places, second_moments);
  interpolation->grid_to_particles(block, places, nodes.data(), {motion, first_moments});
  interpolation->add_vectors(block, places, force, of_forces.data());
  interpolation->particles_to_grid(block,
                                   {places, at_rest, mass, none, no_stress, none, CarriedGradient::gradient, gradient},
                                   false, of_gradients.data());

  ParticleMotion<D> expected{Vector<D>::Zero(), Vector<D>::Zero(), Matrix<D>::Zero()};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector<D> away = node_position(block, static_cast<std::ptrdiff_t>(i)) - position[0];
    first_moments[0] -= shape[i].weight * nodes[i].velocity() * away.transpose();
    second_moments[0] -= shape[i].weight * away * away.transpose();
    expected.velocity += shape[i].weight * nodes[i].velocity();
    expected.velocity_change += shape[i].weight * nodes[i].velocity_change();
    expected.velocity_gradient += nodes[i].velocity() * shape[i].gradient.transpose();
    REQUIRE((of_forces[i].value() - shape[i].weight * force[0]).norm() < 1e-14);
    REQUIRE((of_gradients[i].momentum() - mass[0] * shape[i].weight * gradient[0] * away).norm() < 1e-14);
  }
  CHECK(first_moments[0].norm() < 1e-13 * cell_size);
  CHECK(second_moments[0].norm() < 1e-13 * cell_size * cell_size);
  CHECK((motion[0].velocity - expected.velocity).norm() < 1e-13);
  CHECK((motion[0].velocity_change - expected.velocity_change).norm() < 1e-13);
  CHECK((motion[0].velocity_gradient - expected.velocity_gradient).norm() * cell_size < 1e-13);
}

TEMPLATE_TEST_CASE_SIG(
    "first moments of velocity are brought as the gradients by which the weights' second moments divide", "",
    ((int D), D), 2, 3)
{
  const auto block = block_of_nodes<D>(7, cell_size);
  std::mt19937 random(9);
  const std::vector<Vector<D>> position{random_place(block, random)}, at_rest{Vector<D>::Zero()};
  const std::vector<Matrix<D>> deformation{random_deformation<D>(0.3, random)},
      moment{random_deformation<D>(3, random)};
  const std::vector<double> mass{1.7}, none{0};
  const std::vector<SymmetricTensor<D>> no_stress{SymmetricTensor<D>::Zero()};
  for (const Interpolator interpolator : all_interpolators()) {
    if (!has_second_moments(interpolator)) continue;
    INFO(interpolator.word());
    const auto interpolation = Interpolation<D>::make(interpolator, 2);
    const auto shape = shape_of<D>(interpolator, 2, block, position[0], deformation[0]);
    std::vector<NodeSums<D>> sums(static_cast<std::size_t>(n_nodes_of(block)));

    interpolation->particles_to_grid(
        block, {{position, deformation}, at_rest, mass, none, no_stress, none, CarriedGradient::moment, moment}, false,
        sums.data());

    Matrix<D> of_weights = Matrix<D>::Zero();
    const auto away = [&](std::size_t i) -> Vector<D> {
      return node_position(block, static_cast<std::ptrdiff_t>(i)) - position[0];
    };
    for (std::size_t i = 0; i < sums.size(); ++i) of_weights += shape[i].weight * away(i) * away(i).transpose();
    const Matrix<D> gradient = moment[0] * of_weights.inverse();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Vector<D> expected = mass[0] * shape[i].weight * gradient * away(i);
      REQUIRE((sums[i].momentum() - expected).norm() < 1e-11 * gradient.norm() * cell_size);
      REQUIRE(sums[i].mass() == Approx(mass[0] * shape[i].weight).margin(1e-15));
    }
  }
}

}  // namespace test_interpolators
