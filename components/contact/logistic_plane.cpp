#include "components/contact/logistic_plane.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace tamp::components
{

template <int D>
Vector<D + 1> newton_step(const Vector<D + 1>& plane, const RegressionSums<D>& first, const RegressionSums<D>& second)
{
  // On n; d is all but free.
  Vector<D + 1> ridge = Vector<D + 1>::Constant(1e-3);
  ridge[D] = 1e-8;
  Matrix<D + 1> hessian = first.hessian / first.weight + second.hessian / second.weight;
  hessian.diagonal() += ridge;
  const Vector<D + 1> gradient =
      first.gradient / first.weight + second.gradient / second.weight + ridge.cwiseProduct(plane);
  return plane - hessian.ldlt().solve(gradient);
}

template <int D>
void mark_starts(const GridBlock<D>& block, int support, ContactPlane<D>* planes)
{
  const auto n = [&](std::size_t axis) { return axis < D ? block.n_nodes[axis] : 1; };
  const auto place = [&](const std::array<int, 3>& i) {
    std::ptrdiff_t at = 0;
    for (std::size_t k = 0; k < D; ++k) at += i[k] * block.strides[k];
    return at;
  };
  const auto first = [&](int i) { return std::max(i - support + 1, 0); };
  for (int z = 0; z < n(2); ++z) {
    for (int y = 0; y < n(1); ++y) {
      for (int x = 0; x < n(0); ++x) {
        if (planes[place({x, y, z})].side == 0) continue;
        for (int k = first(z); k <= z; ++k) {
          for (int j = first(y); j <= y; ++j) {
            for (int i = first(x); i <= x; ++i) planes[place({i, j, k})].starts_near = true;
          }
        }
      }
    }
  }
}

template void mark_starts(const GridBlock<2>&, int, ContactPlane<2>*);
template void mark_starts(const GridBlock<3>&, int, ContactPlane<3>*);
template Vector<3> newton_step(const Vector<3>&, const RegressionSums<2>&, const RegressionSums<2>&);
template Vector<4> newton_step(const Vector<4>&, const RegressionSums<3>&, const RegressionSums<3>&);

}  // namespace tamp::components
