#include "components/materials/hypoelastic.hpp"

#include <algorithm>
#include <cstddef>

#include "components/tensor_lanes.hpp"

namespace tamp::components
{

template <int D>
BatchFailure update(const Hypoelastic& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts&)
{
  for (std::size_t i = 0; i < batch.stress.size(); i += n_lanes) {
    const SymmetricTensor<D, Lanes> strain = lanes_at(batch.strain_increment, i);
    const SymmetricTensor<D, Lanes> change = Lanes(2 * solid.shear_modulus) * deviator(strain) +
                                             isotropic<n_symmetric<D>, Lanes>(solid.bulk_modulus * trace(strain));
    set_lanes<n_symmetric<D>, 1>(batch.stress, i, lanes_at(batch.stress, i) + change);
  }
  std::ranges::fill(batch.bulk_modulus, solid.bulk_modulus);
  std::ranges::fill(batch.shear_modulus, solid.shear_modulus);
  std::ranges::fill(batch.plastic_work, 0.0);
  return std::nullopt;
}

template BatchFailure update<2>(const Hypoelastic&, const MaterialBatch<2, NoState>&, UpdateCounts&);
template BatchFailure update<3>(const Hypoelastic&, const MaterialBatch<3, NoState>&, UpdateCounts&);

}  // namespace tamp::components
