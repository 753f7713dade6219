#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "components/anti_locking/anti_locking.hpp"
#include "components/boundary/faces.hpp"
#include "components/choice.hpp"
#include "components/contact/contact_table.hpp"
#include "components/kinematics/deformation_update.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/loads/rotating_frame.hpp"
#include "components/materials/material_model.hpp"
#include "components/shapes/interpolator.hpp"
#include "components/shapes/plane.hpp"
#include "components/transfers/transfers.hpp"
#include "runtime/grid/patch_layout.hpp"
#include "tasks/scene_body.hpp"
#include "tasks/scene_limits.hpp"
#include "tasks/scene_time.hpp"

/// A scene that has been checked: what a run is made from. SI units. Two-dimensional scenes use the first two entries
/// of every triple; their third axis has one layer of cells. They are one metre thick (plane strain), or stand for what
/// turning them about the line x = 0 makes of them (axisymmetric): x is then the distance r from that line, y runs
/// along it, and masses, forces and energies are those of the whole.
namespace tamp::tasks
{

/// When stress follows the motion in a step, and by which velocities of nodes particles deform (Bardenhagen, J. Comput.
/// Phys. 180, 2002).
enum class StressTiming { usl, usf, musl };

inline std::vector<components::Word<StressTiming>> words_of(StressTiming)
{
  return {{"usl", StressTiming::usl, "last, by those that move particles"},
          {"usf", StressTiming::usf,
           "first, by those that particles bring, not for `\"tflip\"` with sand whose `separation` is on"},
          {"musl", StressTiming::musl, "last, by those that particles bring back with their new velocities"}};
}

using components::AntiLocking, components::DeformationUpdate, components::Face, components::Interpolator,
    components::MaterialModel, components::Transfer;

/// Materials are the contact groups too: each has its own velocity field on the grid.
struct SceneMaterial {
  std::string name;
  /// Density of the unstrained material [kg/m^3].
  double density;
  MaterialModel model;
  /// Along each axis of a cell, where it is not that of the scene.
  std::optional<int> own_particles_per_axis{};
};

/// Between two different materials; pairs that are not listed slide freely.
struct SceneContact {
  int material_a;
  int material_b;
  double friction;
  components::ContactNormal normal = components::FlatterNormal();
};

/// Fields of particles, and of nodes as "nodes/NAME", by their names in field files.
struct FieldChoice {
  /// Left out: all.
  std::optional<std::vector<std::string>> names{};

  bool has(const std::string& name) const
  {
    return !names || std::find(names->begin(), names->end(), name) != names->end();
  }
};

struct SceneOutput {
  double fields_interval;
  double history_interval;
  /// How far from a nose its surroundings reach [m].
  double near_nose = 0.01;
  FieldChoice fields{};
};

/// Cells that a patch needs along an axis that is cut. Its particles reach layers of nodes beyond each end; where
/// those of both ends met, some nodes would lack a part of their sums.
constexpr int least_patch_width(Interpolator interpolator)
{
  return 2 * components::n_layers_beyond(interpolator) + 1;
}

struct Scene {
  /// The file's name without its ending; what a run's folder is called by default.
  std::string name;
  std::string title;
  /// Where it is periodic, what leaves at one face enters at the other.
  runtime::Grid grid;
  runtime::Index n_patches;
  bool axisymmetric = false;
  /// faces[axis][0] is the lower one, faces[axis][1] the upper one; along a periodic axis there are none.
  std::array<std::array<Face, 2>, 3> faces{};
  SceneTime time;
  Interpolator interpolator = "gimp";
  Transfer transfer = "flip";
  components::TransferNumbers transfer_numbers{};
  DeformationUpdate deformation_update = "exact";
  AntiLocking anti_locking = AntiLocking::none;
  StressTiming stress_timing = StressTiming::usl;
  /// Along each axis of a cell.
  int particles_per_axis = 2;
  Triple gravity{0, 0, 0};
  /// The frame of the grid, where it turns; in three dimensions only.
  std::optional<components::RotatingFrame> centrifuge;
  std::optional<components::ArtificialViscosity> artificial_viscosity;
  /// See components/loads/local_damping.hpp; 0: none.
  double local_damping = 0;
  std::vector<SceneMaterial> materials;
  std::vector<SceneBody> bodies;
  std::vector<SceneContact> contacts;
  /// Stress updates that may fail in a run before it stops; their particles keep their stress.
  long failed_updates_allowed = 0;
  SceneOutput output;
  SceneLimits limits;

  components::Plane plane() const { return axisymmetric ? components::Plane::revolved : components::Plane::slab; }
  bool is_periodic() const
  {
    return std::find(grid.periodic.begin(), grid.periodic.end(), true) != grid.periodic.end();
  }
  bool has_wall_to_leave() const
  {
    const auto keeps_push = [](const Face& face) { return components::traits_of(face).keeps_push; };
    return std::ranges::any_of(faces, [&](const auto& axis) { return std::ranges::any_of(axis, keeps_push); });
  }
  /// Whether the image of the matter lies behind any of its walls.
  bool has_image_walls() const
  {
    const auto has_image = [](const Face& face) { return components::traits_of(face).has_image(); };
    return std::any_of(faces.begin(), faces.begin() + grid.dimension,
                       [&](const auto& axis) { return std::ranges::any_of(axis, has_image); });
  }
  bool has_body_force() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const SceneBody& body) { return body.functions.body_force; });
  }
  bool has_deformable() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const SceneBody& body) { return !body.rigid; });
  }
  bool is_rigid(int material) const
  {
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](const SceneBody& body) { return body.rigid && body.material == material; });
  }
  /// At the start.
  std::size_t n_particles() const
  {
    std::size_t n = 0;
    for (const SceneBody& body : bodies) n += body.n_particles;
    return n;
  }
  bool has_nose() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const SceneBody& body) { return body.axis.has_value(); });
  }
  int particles_per_axis_of(int material) const
  {
    return materials[static_cast<std::size_t>(material)].own_particles_per_axis.value_or(particles_per_axis);
  }
  /// Distance in cells along an axis from a particle of a material to the furthest node it can reach.
  double reach_of(int material) const { return components::reach(interpolator, particles_per_axis_of(material)); }
  /// How deep beneath a surface the matter lies that its nodes reach [m]; see components::PressedBox.
  double pressed_depth(int material) const { return 2 * reach_of(material) * grid.cell_size; }
};

}  // namespace tamp::tasks
