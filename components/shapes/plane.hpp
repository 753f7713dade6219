#pragma once

namespace tamp::components
{

/// How a plane stands for space: as a slab of unit thickness, or turned about the line x = 0, x being the distance r
/// from it. There a particle is a ring, of mass and volume 2 pi r times those in the plane, and its hoop strain rate is
/// v_r / r, so that the weights S_ip / r_p do work beside the gradients (J. A. Nairn & J. E. Guilkey, Int. J. Numer.
/// Meth. Eng. 101, 2015, with point values in place of their means over r).
enum class Plane { slab, revolved };

}  // namespace tamp::components
