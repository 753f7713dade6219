#pragma once

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Adds a problem for each pair of bodies of which one would have a particle inside of the other.
void check_no_overlap(const tasks::Scene& scene, const JsonReader& bodies);

/// Adds a problem for each body that a plane of symmetry cuts or holds, and whose motion, nose, tail or loads its image
/// does not have: half of a scene that is not symmetric.
void check_mirrored_bodies(const tasks::Scene& scene, const JsonReader& root);

/// Adds a problem for each rigid body whose contact nothing could tell from the start: one that shares its material, as
/// contact is between materials; one that shares a node with another rigid body; one whose nodes reach beyond the grid.
void check_rigid_bodies(const tasks::Scene& scene, const JsonReader& bodies);

/// Adds a problem for each body that is to start settled, and cannot have settled or cannot bear the stress.
void check_settled_bodies(const tasks::Scene& scene, const JsonReader& bodies);

/// Adds a problem where the normal of a contact is to be that of a solid, and the solid is none that matter could
/// touch.
void check_solid(const JsonReader& reader, const tasks::Scene& scene, const tasks::SceneContact& contact);

}  // namespace tamp::tools
