#include "components/anti_locking/volume_changes.hpp"

#include <cstddef>

#include "components/tensor_lanes.hpp"

namespace tamp::components
{

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

template void volume_changes<2>(DeformationUpdate, std::span<const Matrix<2>>, std::span<double>);
template void volume_changes<3>(DeformationUpdate, std::span<const Matrix<3>>, std::span<double>);
template void set_volume_changes<2>(DeformationUpdate, std::span<Matrix<2>>, std::span<const double>);
template void set_volume_changes<3>(DeformationUpdate, std::span<Matrix<3>>, std::span<const double>);

}  // namespace tamp::components
