#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "components/anti_locking/cell_average.hpp"
#include "components/anti_locking/f_bar.hpp"
#include "components/anti_locking/volume_changes.hpp"
#include "components/kinematics/strain_increment.hpp"

namespace test_volume_changes
{

using namespace tamp;
using namespace tamp::components;

namespace
{

template <int D>
std::vector<Matrix<D>> random_steps(int n, double size)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Matrix<D>> g(static_cast<std::size_t>(n));
  for (Matrix<D>& step : g) step = Matrix<D>::NullaryExpr([&] { return uniform(random); });
  return g;
}

/// Reference: f of each update.
template <int D>
Matrix<D> map_of(DeformationUpdate update, const Matrix<D>& g)
{
  return with_update(update, [&]<class Update>(const Update&) { return Update::template map<D, double>(g); });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a step that is given another change of volume has it and keeps its shape", "", ((int D), D), 2,
                       3)
{
  const DeformationUpdate update =
      GENERATE(DeformationUpdate("exact"), DeformationUpdate("first_order"), DeformationUpdate("exponential"));
  const std::vector<Matrix<D>> g = random_steps<D>(37, 0.1);
  std::vector<double> wanted(g.size());
  for (std::size_t p = 0; p < g.size(); ++p) wanted[p] = 0.2 * std::sin(1.0 + static_cast<double>(p));

  std::vector<Matrix<D>> changed = g;
  set_volume_changes<D>(update, changed, wanted);

  for (std::size_t p = 0; p < g.size(); ++p) {
    const Matrix<D> f = map_of<D>(update, g[p]), f_bar = map_of<D>(update, changed[p]);
    REQUIRE(f_bar.determinant() == Approx(1 + wanted[p]).epsilon(1e-14));
    REQUIRE((f_bar / f_bar(0, 0) - f / f(0, 0)).norm() < 1e-14);
  }
}

TEMPLATE_TEST_CASE_SIG("small changes of volume are known to round-off of themselves", "", ((int D), D), 2, 3)
{
  // 1e-9 of a stretch and a shear whose volume change is known: det (1 + g) - 1 = (1 + 2e-9)(1 + 3e-9) - 1 - 20e-18.
  Matrix<D> g = Matrix<D>::Zero();
  g.template topLeftCorner<2, 2>() << 2e-9, 4e-9, 5e-9, 3e-9;
  std::vector<double> change(1);

  volume_changes<D>(DeformationUpdate("exact"), std::vector<Matrix<D>>{g}, change);

  CHECK(change[0] == Approx(5e-9 + 6e-18 - 20e-18).epsilon(1e-15));
}

TEMPLATE_TEST_CASE_SIG("a change of volume is the same however the step turns its particle", "", ((int D), D), 2, 3)
{
  Matrix<D> turn;
  if constexpr (D == 2) {
    turn = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  } else {
    turn = Eigen::AngleAxisd(1.1, Vector<3>(1, 2, -2) / 3).toRotationMatrix();
  }
  const std::vector<Matrix<D>> g = random_steps<D>(11, 0.1);
  const std::vector<double> wanted(g.size(), 0.03);
  std::vector<Matrix<D>> plain = g, turned = g;
  for (Matrix<D>& step : turned) step = turn * (Matrix<D>::Identity() + step) - Matrix<D>::Identity();

  set_volume_changes<D>(DeformationUpdate("exact"), plain, wanted);
  set_volume_changes<D>(DeformationUpdate("exact"), turned, wanted);

  for (std::size_t p = 0; p < g.size(); ++p) {
    const Matrix<D> expected = turn * (Matrix<D>::Identity() + plain[p]) - Matrix<D>::Identity();
    REQUIRE((turned[p] - expected).norm() < 1e-14);
  }
}

TEST_CASE("a ring that is given another change of volume has it, and is stretched alike in all three directions")
{
  const DeformationUpdate update =
      GENERATE(DeformationUpdate("exact"), DeformationUpdate("first_order"), DeformationUpdate("exponential"));
  const auto stretch = [update](double hoop) {
    return with_update(update, [hoop]<class Update>(const Update&) { return Update::stretch(hoop); });
  };
  const std::vector<Matrix<2>> g = random_steps<2>(37, 0.1);
  std::vector<double> hoop(g.size()), wanted(g.size()), own(g.size()), given(g.size());
  for (std::size_t p = 0; p < g.size(); ++p) {
    hoop[p] = 0.1 * std::cos(static_cast<double>(p));
    wanted[p] = 0.2 * std::sin(1.0 + static_cast<double>(p));
  }

  std::vector<Matrix<2>> changed = g;
  std::vector<double> changed_hoop = hoop;
  ring_volume_changes(update, g, hoop, own);
  set_ring_volume_changes(update, changed, changed_hoop, wanted);
  ring_volume_changes(update, changed, changed_hoop, given);

  for (std::size_t p = 0; p < g.size(); ++p) {
    const Matrix<2> f = map_of<2>(update, g[p]), f_bar = map_of<2>(update, changed[p]);
    REQUIRE(1 + own[p] == Approx(f.determinant() * stretch(hoop[p])).epsilon(1e-14));
    REQUIRE(f_bar.determinant() * stretch(changed_hoop[p]) == Approx(1 + wanted[p]).epsilon(1e-14));
    REQUIRE(given[p] == Approx(wanted[p]).margin(1e-15));
    REQUIRE((f_bar / stretch(changed_hoop[p]) - f / stretch(hoop[p])).norm() < 1e-14);
  }
}

TEST_CASE("a particle that is turned inside out stays so whatever its cell does")
{
  std::vector<Matrix<2>> g(1, Matrix<2>::Zero());
  g[0](0, 0) = -1.5;

  set_volume_changes<2>(DeformationUpdate("exact"), g, std::vector<double>{0.1});

  CHECK(g[0](0, 0) == -1.5);
  CHECK(g[0](1, 1) == 0);
}

TEST_CASE("the mean change of a cell keeps the volume of its matter")
{
  CellMean cell;
  cell.add(2, 0.10);
  cell.add(1, -0.05);

  CHECK(cell.mean() == Approx(0.05));
  CHECK(cell.volume * (1 + cell.mean()) == Approx(2 * 1.10 + 1 * 0.95));
}

TEMPLATE_TEST_CASE_SIG("the mean stress that a cell shares does the work of the particles' own on the shared change",
                       "", ((int D), D), 2, 3)
{
  const std::array<double, 2> volume{2, 1}, viscous_pressure{30, 0};
  std::array<SymmetricTensor<D>, 2> stress;
  stress[0].setLinSpaced(-400, 100);
  stress[1].setLinSpaced(50, -250);
  std::array<Matrix<D>, 2> g;
  g[0].setConstant(1e-9);
  g[1] = -3e-9 * Matrix<D>::Identity();
  CellMean change, mean;
  for (std::size_t p = 0; p < 2; ++p) {
    change.add(volume[p], g[p].trace());
    mean.add(volume[p], mean_stress<D>(stress[p], viscous_pressure[p]));
  }

  double by_nodes = 0, by_particles = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    const SymmetricTensor<D> shared = with_mean_stress<D>(stress[p], viscous_pressure[p], mean.mean());
    const Matrix<D> viscous = viscous_pressure[p] * Matrix<D>::Identity();
    const Matrix<D> taken = g[p] + (change.mean() - g[p].trace()) / D * Matrix<D>::Identity();
    by_nodes += volume[p] * (plane_part<D>(shared) - viscous).cwiseProduct(g[p]).sum();
    by_particles += volume[p] * (plane_part<D>(stress[p]) - viscous).cwiseProduct(taken).sum();
    CHECK(mean_stress<D>(shared, viscous_pressure[p]) == Approx(mean.mean()));
    CHECK((deviator(shared) - deviator(stress[p])).tail(stress[p].size() - 3).norm() == 0);
  }
  CHECK(by_nodes == Approx(by_particles).epsilon(1e-12));
}

TEST_CASE("the mean stress that rings share does the work of their own on the shared change, along the hoop too")
{
  // Normal stresses along r, z and the hoop; g_r, g_z and the hoop's g of two rings.
  const std::array<double, 2> volume{2, 1}, viscous_pressure{30, 0};
  const std::array<SymmetricTensor<2>, 2> stress{SymmetricTensor<2>(-400, 100, 70, 20),
                                                 SymmetricTensor<2>(50, -250, -90, 10)};
  const std::array<Vector<3>, 2> g{Vector<3>(1e-9, -2e-9, 4e-9), Vector<3>(-3e-9, 1e-9, -2e-9)};
  CellMean change, mean;
  for (std::size_t p = 0; p < 2; ++p) {
    change.add(volume[p], g[p].sum());
    mean.add(volume[p], mean_stress<3>(stress[p], viscous_pressure[p]));
  }

  double by_nodes = 0, by_particles = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    const SymmetricTensor<2> shared = with_mean_stress<3>(stress[p], viscous_pressure[p], mean.mean());
    const Vector<3> viscous = Vector<3>::Constant(viscous_pressure[p]);
    const Vector<3> taken = g[p] + Vector<3>::Constant((change.mean() - g[p].sum()) / 3);
    by_nodes += volume[p] * (shared.head<3>() - viscous).dot(g[p]);
    by_particles += volume[p] * (stress[p].head<3>() - viscous).dot(taken);
    CHECK(shared[3] == stress[p][3]);
  }
  CHECK(by_nodes == Approx(by_particles).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("the gradient at a cell's centre is that of a linear velocity and of no alternating one", "",
                       ((int D), D), 2, 3)
{
  GridBlock<D> block;
  block.origin.setConstant(-0.5);
  block.cell_size = 0.25;
  std::ptrdiff_t n_nodes = 1;
  for (std::size_t k = 0; k < D; ++k) {
    block.n_nodes[k] = 4;
    block.strides[k] = n_nodes;
    n_nodes *= 4;
  }
  Matrix<D> gradient;
  for (int i = 0; i < D * D; ++i) gradient.data()[i] = 0.3 * i - 0.7;
  std::vector<NodeMotion<D>> nodes(static_cast<std::size_t>(n_nodes));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector<D> cells = block.cells_to(static_cast<std::ptrdiff_t>(i));
    // The last term changes its sign from node to node along every axis.
    const double alternating = std::pow(-1.0, cells.sum());
    nodes[i].set(gradient * (block.origin + block.cell_size * cells) + alternating * Vector<D>::Ones(),
                 Vector<D>::Zero());
  }
  const std::vector<Vector<D>> places{Vector<D>::Constant(-0.49), Vector<D>::Constant(0.1)};
  std::vector<double> inverse_mass(nodes.size(), 1);
  std::vector<Matrix<D>> g(places.size(), Matrix<D>::Zero());

  centre_gradients<D>(block, nodes.data(), inverse_mass.data(), places, 0.1, g);

  for (const Matrix<D>& step : g) CHECK((step - 0.1 * gradient).norm() < 1e-15);

  // A corner of the second cell alone: what is not there has no velocity.
  inverse_mass.back() = 0;
  g.assign(2, Matrix<D>::Identity());
  centre_gradients<D>(block, nodes.data(), inverse_mass.data(), places, 0.1, g);

  CHECK((g[0] - 0.1 * gradient).norm() < 1e-15);
  CHECK(g[1] == Matrix<D>::Identity());
}

TEST_CASE("at a cell's centre the hoop of a ring is stretched as rings there are, on the axis too")
{
  // v_r = 0.3 r - 0.2 r z: v_r / r at the centre of a cell is 0.3 - 0.2 z there.
  GridBlock<2> block;
  block.origin.setZero();
  block.cell_size = 0.25;
  block.n_nodes = {4, 4};
  block.strides = {1, 4};
  std::vector<NodeMotion<2>> nodes(16);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector<2> x = block.cell_size * block.cells_to(static_cast<std::ptrdiff_t>(i));
    nodes[i].set(Vector<2>(0.3 * x[0] - 0.2 * x[0] * x[1], 0), Vector<2>::Zero());
  }
  const std::vector<double> inverse_mass(nodes.size(), 1);
  const std::vector<Vector<2>> places{Vector<2>(0.01, 0.2), Vector<2>(0.6, 0.3)};
  std::vector<Matrix<2>> g(places.size(), Matrix<2>::Zero());
  std::vector<double> hoop(places.size(), 0);

  centre_gradients<2>(block, nodes.data(), inverse_mass.data(), places, 0.1, g, hoop);

  CHECK(hoop[0] == Approx(0.1 * (0.3 - 0.2 * 0.125)).epsilon(1e-14));
  CHECK(hoop[1] == Approx(0.1 * (0.3 - 0.2 * 0.375)).epsilon(1e-14));
}

}  // namespace test_volume_changes
