#pragma once

#include <span>

#include "components/loads/pressure_load.hpp"
#include "components/shapes/interpolation.hpp"

namespace tamp::components
{

/// Adds to the nodes what particles bring of a pressure load, m_p P_p S_ip; `pressure` is m_p P_p of each.
template <int D>
void add_pressure(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                  std::span<const ByFace<D>> pressure, PressureSums<D>* sums);

}  // namespace tamp::components
