#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A disk or a ring that turns about its centre as a rigid body would, anticlockwise, without stress: the body force
/// -w^2 (x - centre) that holds its points on their circles is given. In the plane only; its particles lie on rings.
struct RotatingDisk {
  static constexpr std::string_view type = "rotating_disk";
  static constexpr std::string_view meaning =
      "a disk or a ring in the plane that turns as a rigid body would, held on its circles by a body force. Its "
      "particles lie on rings about as wide as their spacing in the lattice, in sectors about as long; each has the "
      "volume of its sector";
  static constexpr std::array<Parameter<RotatingDisk>, 4> parameters();

  Vector<3> centre;         ///< m
  double outer_radius;      ///< m
  double angular_speed;     ///< w [rad/s]
  double inner_radius = 0;  ///< m; 0: a disk

  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<RotatingDisk>, 4> RotatingDisk::parameters()
{
  return {{{"centre", "m", any_number, &RotatingDisk::centre},
           {"outer_radius", "m", above_zero, &RotatingDisk::outer_radius},
           {"angular_speed", "rad/s", any_number, &RotatingDisk::angular_speed},
           {"inner_radius", "m", zero_or_above, &RotatingDisk::inner_radius, "", true}}};
}

}  // namespace tamp::components
