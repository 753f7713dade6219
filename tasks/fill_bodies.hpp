#pragma once

#include "runtime/data/warehouse.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// Puts the particles of all bodies into the patches that own their cells, at rest in themselves and moving with their
/// body. Ids count bodies and cells, and so do not depend on the cut into patches.
template <int D>
void fill_bodies(const Scene& scene, runtime::Warehouse& warehouse);

}  // namespace tamp::tasks
