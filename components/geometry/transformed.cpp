#include "components/geometry/transformed.hpp"

#include "components/geometry/checks.hpp"

namespace tamp::components
{

template <int D>
bool Transformed<D>::contains(const Vector<D>& x) const
{
  return solid.contains(rotation.transpose() * (x - translation));
}

template <int D>
double Transformed<D>::reach(const Vector<D>& direction) const
{
  return solid.reach(rotation.transpose() * direction) + translation.dot(direction);
}

template <int D>
Volume Transformed<D>::volume() const
{
  return solid.volume();
}

template <int D>
void Transformed<D>::check() const
{
  require_rotation<D>(rotation);
  require_finite<D>(translation, "translation");
}

template struct Transformed<2>;
template struct Transformed<3>;

}  // namespace tamp::components
