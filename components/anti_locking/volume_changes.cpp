#include "components/anti_locking/volume_changes.hpp"

#include <cstddef>

#include "components/tensor_lanes.hpp"

namespace tamp::components
{

namespace
{

/// The gradients of rings in space.
Matrix<3, Lanes> across_too(const Matrix<2, Lanes>& g, const Lanes& hoop)
{
  Matrix<3, Lanes> in_space = Matrix<3, Lanes>::Zero();
  in_space.topLeftCorner<2, 2>() = g;
  in_space(2, 2) = hoop;
  return in_space;
}

}  // namespace

template <int D>
[[gnu::flatten]] void volume_changes(DeformationUpdate update, std::span<const Matrix<D>> g, std::span<double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      set_lanes(change, p, Update::template volume_change<D, Lanes>(lanes_at(g, p)));
    }
  });
}

template <int D>
[[gnu::flatten]] void set_volume_changes(DeformationUpdate update, std::span<Matrix<D>> g,
                                         std::span<const double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      set_lanes(g, p, Update::template with_volume_change<D, Lanes>(lanes_at(g, p), lanes_at(change, p)));
    }
  });
}

[[gnu::flatten]] void ring_volume_changes(DeformationUpdate update, std::span<const Matrix<2>> g,
                                          std::span<const double> hoop, std::span<double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      const Matrix<3, Lanes> own = across_too(lanes_at(g, p), lanes_at(hoop, p));
      set_lanes(change, p, Update::template volume_change<3, Lanes>(own));
    }
  });
}

[[gnu::flatten]] void set_ring_volume_changes(DeformationUpdate update, std::span<Matrix<2>> g, std::span<double> hoop,
                                              std::span<const double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      const Matrix<3, Lanes> own = across_too(lanes_at(g, p), lanes_at(hoop, p));
      const Matrix<3, Lanes> changed = Update::template with_volume_change<3, Lanes>(own, lanes_at(change, p));
      set_lanes(g, p, Matrix<2, Lanes>(changed.topLeftCorner<2, 2>()));
      set_lanes(hoop, p, changed(2, 2));
    }
  });
}

template void volume_changes<2>(DeformationUpdate, std::span<const Matrix<2>>, std::span<double>);
template void volume_changes<3>(DeformationUpdate, std::span<const Matrix<3>>, std::span<double>);
template void set_volume_changes<2>(DeformationUpdate, std::span<Matrix<2>>, std::span<const double>);
template void set_volume_changes<3>(DeformationUpdate, std::span<Matrix<3>>, std::span<const double>);

}  // namespace tamp::components
