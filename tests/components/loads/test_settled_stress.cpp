#include "components/loads/settled_stress.hpp"

#include <catch2/catch.hpp>

#include "components/boundary/symmetry.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/transfer.hpp"

namespace test_settled_stress
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double density = 1600;

/// Layers that fill `height` cells of a grid of 8, `n_per_cell` in each, above a wall at 0.
LayerColumn layers_above_wall(double cell_size, int n_per_cell, double height, bool upper_wall = false)
{
  LayerColumn column{{Vector<1>(-cell_size), cell_size, {11}, {1}}, true, upper_wall, {}, cell_size / n_per_cell, {}};
  for (int l = 0; (l + 0.5) / n_per_cell < height; ++l) column.layers.push_back((l + 0.5) * column.spacing);
  column.density.assign(column.layers.size(), density);
  return column;
}

/// Largest internal force plus body force of a free node over its mass, by the kernels of a step in the plane: the
/// column stands along y in one cell between walls along x.
double greatest_acceleration(const LayerColumn& column, const std::vector<double>& stress, int n_per_cell,
                             const LinearForce& force)
{
  const double h = column.nodes.cell_size;
  const GridBlock<2> block{{-h, -h}, h, {4, 11}, {1, 4}};
  std::vector<Vector<2>> position;
  std::vector<SymmetricTensor<2>> stresses;
  for (std::size_t l = 0; l < column.layers.size(); ++l) {
    for (int i = 0; i < n_per_cell; ++i) {
      position.emplace_back((i + 0.5) * column.spacing, column.layers[l]);
      stresses.push_back((SymmetricTensor<2>() << 0.3 * stress[l], stress[l], 0, 0).finished());
    }
  }
  const std::size_t n = position.size();
  const double volume = column.spacing * column.spacing;
  const std::vector<Vector<2>> velocity(n, Vector<2>::Zero());
  const std::vector<double> masses(n, density * volume), volumes(n, volume), none(n, 0.0);
  std::vector<NodeSums<2>> sums(4 * 11);
  particles_to_grid(Gimp<2>(n_per_cell), block, {{position}, velocity, masses, volumes, stresses, none}, sums.data());
  SymmetryWall<2>({4, 11}, 0, 1, -1).fold(sums.data());
  SymmetryWall<2>({4, 11}, 0, 2, +1).fold(sums.data());
  SymmetryWall<2>({4, 11}, 1, 1, -1).fold(sums.data());
  if (column.upper_wall) SymmetryWall<2>({4, 11}, 1, 9, +1).fold(sums.data());

  double greatest = 0;
  for (std::size_t j = 2; j < (column.upper_wall ? 9 : 11); ++j) {
    for (const std::size_t i : {1UL, 2UL}) {
      const NodeSums<2>& node = sums[4 * j + i];
      if (node.mass() < 1e-20 * density * volume) continue;
      const double y = (static_cast<double>(j) - 1) * h;
      greatest = std::max(greatest, std::abs(node.internal_force()[1] / node.mass() + force.at(y)));
    }
  }
  return greatest;
}

}  // namespace

TEST_CASE("one layer in each cell carries the layers above it and half of itself")
{
  const double g = 10;

  const auto stress = settled_stress("gimp", 1, layers_above_wall(2, 1, 3), {-g, 0});

  REQUIRE(stress.size() == 3);
  for (std::size_t l = 0; l < 3; ++l) {
    CHECK(stress[l] == Approx(-density * g * 2 * (2.5 - static_cast<double>(l))).epsilon(1e-14));
  }
}

TEST_CASE("layers carry those above them, each of its own density, on a floor or under a ceiling")
{
  const double g = 10;
  LayerColumn column = layers_above_wall(2, 1, 3);
  column.density = {2600, 1600, 2000};
  LayerColumn hanging = column;
  hanging.layers = {11, 13, 15};
  hanging.lower_wall = false;
  hanging.upper_wall = true;

  const auto stress = settled_stress("gimp", 1, column, {-g, 0});
  const auto pull = settled_stress("gimp", 1, hanging, {-g, 0});

  const std::vector<double> above{1600 + 2000 + 1300, 2000 + 800, 1000}, below{1300, 2600 + 800, 2600 + 1600 + 1000};
  for (std::size_t l = 0; l < 3; ++l) {
    CHECK(stress[l] == Approx(-g * 2 * above[l]).epsilon(1e-14));
    CHECK(pull[l] == Approx(g * 2 * below[l]).epsilon(1e-14));
  }
}

TEST_CASE("settled layers are at rest on every free node, whatever their number in a cell and their height")
{
  const int n_per_cell = GENERATE(1, 2, 3);
  const double height = GENERATE(2.0, 4.5, 5.2, 6.0);
  const LinearForce force{-200, GENERATE(0.0, 36.0)};
  const LayerColumn column = layers_above_wall(0.005, n_per_cell, height);

  const auto stress = settled_stress("gimp", n_per_cell, column, force);

  CHECK(greatest_acceleration(column, stress, n_per_cell, force) < 1e-12 * 200);
  const Eigen::VectorXd weight = continuum_stress(column, force);
  for (std::size_t l = 0; l < stress.size(); ++l) {
    // Within the weight of a quarter of a cell.
    CHECK(std::abs(stress[l] - weight[static_cast<Eigen::Index>(l)]) < 0.25 * density * 200 * 0.005);
  }
}

TEST_CASE("layers between two walls balance a force that grows along them, with a mean of zero")
{
  const int n_per_cell = GENERATE(1, 2, 3);
  const LinearForce force{-36 * 0.013, 36};
  const LayerColumn column = layers_above_wall(0.005, n_per_cell, 8, true);

  const auto stress = settled_stress("gimp", n_per_cell, column, force);

  CHECK(greatest_acceleration(column, stress, n_per_cell, force) < 1e-12);
  double mean = 0;
  for (const double s : stress) mean += s / static_cast<double>(stress.size());
  CHECK(std::abs(mean) < 1e-3 * density * 36 * 0.04 * 0.04);
}

}  // namespace test_settled_stress
