#include <catch2/catch.hpp>

#include <map>
#include <utility>
#include <vector>

#include "tests/components/shapes/shape_reference.hpp"

namespace test_gimp
{

using namespace tamp;
using namespace tamp::components;
using namespace tamp::test;

namespace
{

constexpr double cell_size = 0.04;
constexpr int n_places = 500;

/// Weight and gradient at each node that a particle reaches, by place in the block.
template <int D>
std::map<std::ptrdiff_t, std::pair<double, Vector<D>>> shape_at(const Gimp<D>& gimp, const GridBlock<D>& block,
                                                                const Vector<D>& x)
{
  std::map<std::ptrdiff_t, std::pair<double, Vector<D>>> shape;
  const auto stencil = gimp.at(block, x);
  for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
    for (std::size_t i = 0; i < Gimp<D>::support; ++i) {
      Vector<D> gradient;
      gradient << stencil.slope[0][i] * row.across, stencil.weight[0][i] * row.slope_across;
      shape[row.first + static_cast<std::ptrdiff_t>(i)] = {stencil.weight[0][i] * row.across, gradient};
    }
  });
  return shape;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("weights sum to one and gradients to zero anywhere", "", ((int D), D), 2, 3)
{
  const Gimp<D> gimp = GENERATE(Gimp<D>(2), Gimp<D>(3), Gimp<D>(4), Gimp<D>::quadratic_spline());
  const auto block = block_of_nodes<D>(7, cell_size);
  std::mt19937 random(1);
  for (int i = 0; i < n_places; ++i) {
    const auto shape = shape_at(gimp, block, random_place(block, random));

    double weights = 0;
    Vector<D> gradients = Vector<D>::Zero();
    for (const auto& [place, node] : shape) {
      REQUIRE(node.first >= 0);
      weights += node.first;
      gradients += node.second;
    }

    REQUIRE(shape.size() == (D == 2 ? 9 : 27));
    REQUIRE(weights == Approx(1).epsilon(4e-15));
    REQUIRE(gradients.norm() * cell_size < 4e-15);
  }
}

TEMPLATE_TEST_CASE_SIG("the stencils of a batch are those of its particles, bit for bit", "", ((int D), D), 2, 3)
{
  const Gimp<D> gimp = GENERATE(Gimp<D>(2), Gimp<D>(3), Gimp<D>::quadratic_spline());
  const auto n_particles = GENERATE(as<std::size_t>(), 1, 7, StencilBatch<D, 3>::capacity);
  const auto block = block_of_nodes<D>(7, cell_size);
  std::mt19937 random(3);
  std::vector<Vector<D>> position;
  for (std::size_t p = 0; p < n_particles; ++p) position.push_back(random_place(block, random));
  // Where the formula changes: as far from a node as half a particle.
  position[0] = block.origin + Vector<D>::Constant(cell_size * (2 + gimp.half_size()));
  StencilBatch<D, 3> batch;

  gimp.fill(batch, block, {position});

  for (std::size_t p = 0; p < n_particles; ++p) {
    const auto alone = gimp.at(block, position[p]), own = batch[p];
    REQUIRE(own.first == alone.first);
    REQUIRE(own.weight == alone.weight);
    REQUIRE(own.slope == alone.slope);
    const auto lanes = batch.lanes(p - p % n_lanes);
    REQUIRE(double{lanes.weight[D - 1][1][p % n_lanes]} == alone.weight[D - 1][1]);
    REQUIRE(double{lanes.slope[0][2][p % n_lanes]} == alone.slope[0][2]);
  }
}

TEMPLATE_TEST_CASE_SIG("a linear field and its gradient are interpolated exactly", "", ((int D), D), 2, 3)
{
  const Gimp<D> gimp = GENERATE(Gimp<D>(2), Gimp<D>(3), Gimp<D>(4), Gimp<D>::quadratic_spline());
  const auto block = block_of_nodes<D>(7, cell_size);
  std::mt19937 random(2);
  for (int i = 0; i < n_places; ++i) {
    const Vector<D> x = random_place(block, random);

    Vector<D> position = Vector<D>::Zero();
    Matrix<D> gradient = Matrix<D>::Zero();
    for (const auto& [place, node] : shape_at(gimp, block, x)) {
      position += node.first * node_position(block, place);
      gradient += node_position(block, place) * node.second.transpose();
    }

    REQUIRE((position - x).norm() < 1e-14);
    REQUIRE((gradient - Matrix<D>::Identity()).norm() < 1e-13);
  }
}

TEMPLATE_TEST_CASE_SIG("the quadratic spline has weights of 3/4 and 1/8 at a node, and of halves between two", "",
                       ((int D), D), 2, 3)
{
  const auto block = block_of_nodes<D>(7, cell_size);
  const auto spline = Gimp<D>::quadratic_spline();
  const auto along_x = [&](double cells) {
    return spline.at(block, block.origin + Vector<D>::Constant(cells * cell_size));
  };

  const auto at_node = along_x(3), between = along_x(3.5), beside = along_x(3.2);

  CHECK(at_node.weight[0][0] == Approx(0.125));
  CHECK(at_node.weight[0][1] == Approx(0.75));
  CHECK(at_node.slope[0][2] * cell_size == Approx(0.5));
  CHECK(between.weight[0][0] == Approx(0.5));
  CHECK(between.weight[0][1] == Approx(0.5));
  // (1/2 - u)^2 / 2, 3/4 - u^2 and (1/2 + u)^2 / 2 at u = 0.2.
  CHECK(beside.weight[0][0] == Approx(0.045));
  CHECK(beside.weight[0][1] == Approx(0.71));
  CHECK(beside.slope[0][1] * cell_size == Approx(-0.4));
}

TEMPLATE_TEST_CASE_SIG("weights are means of the linear functions over the particle's box", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 3, 4);
  const Gimp<D> gimp(n_per_axis);
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(3);
  for (int i = 0; i < n_places; ++i) {
    const Vector<D> x = random_place(block, random);
    const auto shape = shape_at(gimp, block, x);

    for (std::ptrdiff_t place = 0; place < n_nodes_of(block); ++place) {
      const PlainShape<D> plain(x, node_position(block, place), 0.5 / n_per_axis, cell_size);
      const auto found = shape.find(place);
      const double weight = found == shape.end() ? 0 : found->second.first;
      const Vector<D> gradient = found == shape.end() ? Vector<D>::Zero() : found->second.second;

      REQUIRE(weight == Approx(plain.weight).margin(4e-15));
      REQUIRE((gradient - plain.gradient).norm() * cell_size < 4e-14);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("weights and gradients are continuous where the reached nodes change", "", ((int D), D), 2, 3)
{
  const int n_per_axis = GENERATE(1, 2, 3, 4);
  const Gimp<D> gimp(n_per_axis);
  const auto block = block_of_nodes<D>(6, cell_size);
  std::mt19937 random(4);
  const double l = 0.5 / n_per_axis;
  const double little = 1e-9;
  // The particle's box touches a node from either side, and is centred on one and on the middle of a cell.
  for (const double kink : {2 + l, 3 - l, 2.0, 2.5}) {
    for (int axis = 0; axis < D; ++axis) {
      Vector<D> below = random_place(block, random);
      below[axis] = block.origin[axis] + (kink - little) * cell_size;
      Vector<D> above = below;
      above[axis] = block.origin[axis] + (kink + little) * cell_size;

      auto jump = shape_at(gimp, block, below);
      for (const auto& [place, node] : shape_at(gimp, block, above)) {
        if (!jump.contains(place)) jump[place] = {0, Vector<D>::Zero()};
        jump[place].first -= node.first;
        jump[place].second -= node.second;
      }

      // Slopes are at most 1 and curvatures at most 1 / l, per cell.
      for (const auto& [place, node] : jump) {
        CHECK(std::abs(node.first) <= 2.1 * little);
        CHECK(node.second.norm() * cell_size <= 2.1 * little * (D + 1 / l));
      }
    }
  }
}

}  // namespace test_gimp
