#include "components/contact/logistic_plane.hpp"

#include <Eigen/Cholesky>

namespace tamp::components
{

template <int D>
Vector<D + 1> newton_step(const Vector<D + 1>& plane, const RegressionSums<D>& first, const RegressionSums<D>& second)
{
  // On n; d is all but free.
  Vector<D + 1> ridge = Vector<D + 1>::Constant(1e-3);
  ridge[D] = 1e-8;
  Matrix<D + 1> hessian = first.hessian() / first.weight() + second.hessian() / second.weight();
  hessian.diagonal() += ridge;
  const Vector<D + 1> gradient =
      first.gradient() / first.weight() + second.gradient() / second.weight() + ridge.cwiseProduct(plane);
  return plane - hessian.ldlt().solve(gradient);
}

template Vector<3> newton_step(const Vector<3>&, const RegressionSums<2>&, const RegressionSums<2>&);
template Vector<4> newton_step(const Vector<4>&, const RegressionSums<3>&, const RegressionSums<3>&);

}  // namespace tamp::components
