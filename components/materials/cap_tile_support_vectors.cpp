#include "components/materials/cap_tile.hpp"

namespace tamp::components
{

template class CapTile<SupportVectorModulus>;
template class CapTile<EngineeringStrain<SupportVectorModulus>>;

}  // namespace tamp::components
