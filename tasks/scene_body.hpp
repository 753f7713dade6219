#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "components/geometry/solid.hpp"
#include "components/loads/pressure_load.hpp"
#include "components/problems/body_functions.hpp"
#include "components/rigid/prescribed_motion.hpp"

namespace tamp::tasks
{

using Triple = std::array<double, 3>;

/// Something of each face of the domain, as [axis][side]; side 0 is the lower.
using Sides = std::array<std::array<bool, 2>, 3>;

using AnySolid = std::variant<components::Solid<2>, components::Solid<3>>;

/// The ends of a body that is longer than it is wide, at the start [m].
struct BodyAxis {
  Triple nose;
  Triple tail;
};

/// How a rigid body is driven.
struct BodyDrive {
  components::PrescribedMotion motion;
  /// Turned by what it touches, or not at all.
  bool turns = false;
};

/// On the surface of a body, or on the part of it that starts within a box.
struct BodyPressure {
  components::PressureCurve curve;
  components::PressedBox<3> box{};

  /// The box in a scene of D dimensions.
  template <int D>
  components::PressedBox<D> box_of() const
  {
    return {box.lower.head<D>(), box.upper.head<D>()};
  }
};

/// Where the particles of a body lie: at sites of the lattice, there but cut at the outline, or on the rings that its
/// functions give.
enum class ParticleLayout { lattice, cut, rings };

struct SceneBody {
  std::string name;
  /// Place in Scene::materials.
  int material;
  AnySolid solid;
  Triple velocity{0, 0, 0};
  std::size_t n_particles;
  /// About the centre of mass [rad/s]; in plane strain its third entry alone.
  Triple angular_velocity{0, 0, 0};
  /// Keeps its shape: its material gives it mass, but no stress, and is no other body's.
  bool rigid = false;
  /// Set for a rigid body that is driven; `velocity` is then the one it starts with.
  std::optional<BodyDrive> drive{};
  /// Followed in reports.
  std::optional<BodyAxis> axis{};
  /// Ground that has settled in its place, with this stress across over that along the vertical: see SettledGround.
  bool initial_stress = false;
  std::optional<double> k0{};
  /// Only on a body that is not rigid.
  std::optional<BodyPressure> pressure{};
  /// The functions of its problem, if it has one: they say more of its start than the above, and what acts on it. A
  /// disk without one may have its layout alone.
  components::BodyFunctions functions{};

  ParticleLayout particles = ParticleLayout::lattice;

  /// Faces of the grid at which its solid has been cut in halves: `solid` is the part within.
  Sides cut{};

  bool is_cut() const { return cut != Sides{}; }
  bool is_pressed() const { return pressure.has_value() || functions.pressure; }
};

}  // namespace tamp::tasks
