#include "components/geometry/checks.hpp"

#include <cmath>
#include <sstream>

#include "components/errors.hpp"

namespace tamp::components
{

template <int D>
std::string text(const Vector<D>& v)
{
  std::ostringstream out;
  out << v.transpose().format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", ", ", "", "", "[", "]"));
  return out.str();
}

template <int D>
void require_finite(const Vector<D>& v, const char* name)
{
  if (!v.allFinite()) throw BadValue(std::string(name) + " " + text<D>(v), "finite coordinates");
}

void require_positive(double length, const char* name)
{
  if (!(length > 0) || !std::isfinite(length)) {
    throw BadValue(std::string(name) + " " + std::to_string(length), "a finite length above 0");
  }
}

template <int D>
void require_rotation(const Matrix<D>& rotation)
{
  const double departure = (rotation.transpose() * rotation - Matrix<D>::Identity()).norm();
  if (departure < 1e-9 && rotation.determinant() > 0) return;
  std::ostringstream found;
  found << "rotation " << rotation.format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", ", ", "[", "]", "[", "]"));
  throw BadValue(found.str(), "an orthogonal matrix of determinant 1");
}

template std::string text<2>(const Vector<2>&);
template std::string text<3>(const Vector<3>&);
template void require_finite<2>(const Vector<2>&, const char*);
template void require_finite<3>(const Vector<3>&, const char*);
template void require_rotation<2>(const Matrix<2>&);
template void require_rotation<3>(const Matrix<3>&);

}  // namespace tamp::components
