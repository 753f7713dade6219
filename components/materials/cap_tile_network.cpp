#include "components/materials/cap_tile.hpp"

namespace tamp::components
{

template class CapTile<NetworkModulus>;
template class CapTile<EngineeringStrain<NetworkModulus>>;

}  // namespace tamp::components
