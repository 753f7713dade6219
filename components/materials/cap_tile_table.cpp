#include "components/materials/cap_tile.hpp"

namespace tamp::components
{

template class CapTile<UnloadingTable>;
template class CapTile<ModulusSurface>;

}  // namespace tamp::components
