#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/anti_locking/anti_locking.hpp"
#include "components/boundary/faces.hpp"
#include "components/choice.hpp"
#include "components/contact/contact_table.hpp"
#include "components/geometry/solid.hpp"
#include "components/kinematics/deformation_update.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/loads/pressure_load.hpp"
#include "components/loads/rotating_frame.hpp"
#include "components/loads/time_step.hpp"
#include "components/materials/material_model.hpp"
#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"
#include "components/rigid/prescribed_motion.hpp"
#include "components/shapes/interpolator.hpp"
#include "components/shapes/plane.hpp"
#include "components/transfers/transfers.hpp"
#include "runtime/grid/patch_layout.hpp"

/// A scene that has been checked: what a run is made from. SI units. Two-dimensional scenes use the first two entries
/// of every triple; their third axis has one layer of cells. They are one metre thick (plane strain), or stand for what
/// turning them about the line x = 0 makes of them (axisymmetric): x is then the distance r from that line, y runs
/// along it, and masses, forces and energies are those of the whole.
namespace tamp::tasks
{

using Triple = std::array<double, 3>;

/// Something of each face of the domain, as [axis][side]; side 0 is the lower.
using Sides = std::array<std::array<bool, 2>, 3>;

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

using components::Face;

using components::Interpolator;

using components::Transfer;

using components::AntiLocking;
using components::DeformationUpdate;
using components::StepRule;

struct SceneTime {
  double end;
  StepRule rule = StepRule::viscous;
  /// The part of the bound that is used.
  double multiplier = 0.8;
  double minimum_step = 1e-12;
  double maximum_step = std::numeric_limits<double>::infinity();
  /// A step that goes wrong is tried so many times again, each as much of the time before.
  int redos = 8;
  double redo_factor = 0.5;

  /// All but the rule.
  static constexpr std::array<components::Parameter<SceneTime>, 6> parameters();
};

constexpr std::array<components::Parameter<SceneTime>, 6> SceneTime::parameters()
{
  using components::above_zero;
  return {{{"end", "s", above_zero, &SceneTime::end, "simulated time"},
           {"multiplier",
            "",
            {.lower = 0, .upper = 100, .holds_lower = false},
            &SceneTime::multiplier,
            "the part of that bound that is used, above 0 and up to 100; above 1 steps are longer than is known to be "
            "stable",
            true},
           {"minimum_step", "s", above_zero, &SceneTime::minimum_step,
            "the run stops as unstable if its time step has to be shorter", true},
           {"maximum_step", "s", above_zero, &SceneTime::maximum_step, "longest time step", true},
           {"redos",
            "",
            {.lower = 0, .upper = 100},
            &SceneTime::redos,
            "a step that goes wrong is tried again, shorter, at most so many times, see failures.md; 0: the run ends",
            true},
           {"redo_factor",
            "",
            {.lower = 0, .upper = 1, .holds_lower = false, .holds_upper = false},
            &SceneTime::redo_factor,
            "the length of a step that is tried again, as a part of the one that went wrong",
            true}}};
}

using components::MaterialModel;

/// Materials are the contact groups too: each has its own velocity field on the grid.
struct SceneMaterial {
  std::string name;
  /// Density of the unstrained material [kg/m^3].
  double density;
  MaterialModel model;
  /// Along each axis of a cell, where it is not that of the scene.
  std::optional<int> own_particles_per_axis{};
};

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
  /// Sand that has settled in its place: see SettledSand.
  bool initial_stress = false;
  /// Only on a body that is not rigid.
  std::optional<BodyPressure> pressure{};
  /// The functions of its problem, if it has one: they say more of its start than the above, and what acts on it. A
  /// disk without one may have its layout alone.
  components::BodyFunctions functions{};

  /// Faces of the grid at which its solid has been cut in halves: `solid` is the part within.
  Sides cut{};

  bool is_cut() const { return cut != Sides{}; }
  bool is_pressed() const { return pressure.has_value() || functions.pressure; }
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

/// Beyond these a run has gone wrong or is not to be trusted: beyond the first it ends, beyond the second a step is
/// tried again, beyond the others the run ends with a warning. docs/failures.md has where they come from.
struct SceneLimits {
  double energy_error = 0.2;
  double courant_number = 1;
  double redone_steps = 0.1;
  double missed_substeps = 0.05;
  double swollen_load = 0.3;
  double looser_than_tested = 0.2;
  double out_of_range = 0.2;
  double energy_drift = 0.02;
  double momentum_error = 0.01;
  double filtered_energy = 0.1;
  double damped_energy = 0.05;
  double null_space = 0.25;
  double uneven_pressure = 0.5;
  double torn_apart = 0.01;
  double early_contact = 0.1;
  double interpenetration = 0.1;
  double lost_mass = 0.01;
  double forecast_missed = 2;
  int sampled_every = 50;

  bool samples_after(long n_steps) const { return n_steps % sampled_every == 0; }
  /// All but the first.
  static constexpr std::array<components::Parameter<SceneLimits>, 18> parameters();
};

constexpr std::array<components::Parameter<SceneLimits>, 18> SceneLimits::parameters()
{
  using components::above_zero, components::zero_or_above;
  using L = SceneLimits;
  constexpr components::Range part{.lower = 0, .upper = 1};
  return {
      {{"courant_number", "", above_zero, &L::courant_number,
        "a step in which waves, as fast as they are at its end, cross more cells than this has gone wrong: matter has "
        "grown too stiff for it (see `/time/redos`; times the `multiplier` where that is above 1)",
        true},
       {"redone_steps", "", zero_or_above, &L::redone_steps,
        "warns beyond: tries of steps that went wrong, over all steps", true},
       {"missed_substeps", "", part, &L::missed_substeps,
        "warns beyond: the part of the materials' substeps that missed their tolerance, from 100 substeps a particle "
        "on",
        true},
       {"swollen_load", "", part, &L::swollen_load,
        "warns beyond: the greatest part of the mass that has swollen to more than 1.2 times its first volume and yet "
        "bears more than a hundredth of the greatest load in any sample",
        true},
       {"looser_than_tested", "", part, &L::looser_than_tested,
        "warns beyond: the most that sand bears (the sum of V p) which has dilated until it is looser than any that "
        "was "
        "tested, over the most that all sand bears in a sample",
        true},
       {"out_of_range", "", part, &L::out_of_range,
        "warns beyond: the part of the updates that ended in compression beyond the largest strains that the modulus "
        "was made for",
        true},
       {"energy_drift", "", zero_or_above, &L::energy_drift,
        "warns beyond: the error of the energy at the end, over what the run has been given", true},
       {"momentum_error", "", zero_or_above, &L::momentum_error,
        "warns beyond: momentum that nothing has given, over the largest sum of m v", true},
       {"filtered_energy", "", zero_or_above, &L::filtered_energy,
        "warns beyond: the energy that particles have filtered out of the motion, over what the run has been given",
        true},
       {"damped_energy", "", zero_or_above, &L::damped_energy,
        "warns beyond: the energy that local damping took, as far as motion, plastic strain and friction stand beside "
        "it, over what the run has been given",
        true},
       {"null_space", "", part, &L::null_space,
        "warns beyond: the part of the kinetic and elastic energy that is of motion which no node sees, over all "
        "samples",
        true},
       {"uneven_pressure", "", part, &L::uneven_pressure,
        "warns beyond: how far the pressures of particles are from the means of their cells, V (p - p_c)^2 over V p^2, "
        "over all samples",
        true},
       {"torn_apart", "", part, &L::torn_apart,
        "warns beyond: the greatest part of elastic particles that hold tension across more than 1.2 cells", true},
       {"early_contact", "", part, &L::early_contact,
        "warns beyond: the part of the contact impulses between materials that are more than a quarter of a cell "
        "apart, over all samples",
        true},
       {"interpenetration", "", part, &L::interpenetration,
        "warns beyond: the part of the contact impulses between materials that are more than half a cell within each "
        "other, over all samples",
        true},
       {"lost_mass", "", part, &L::lost_mass, "warns beyond: the part of the mass that has left the grid", true},
       {"forecast_missed",
        "",
        {.lower = 1},
        &L::forecast_missed,
        "warns beyond: the factor by which a run took more memory or disk space than was forecast, or more or fewer "
        "steps",
        true},
       {"sampled_every",
        "",
        {.lower = 1, .upper = 1e6},
        &L::sampled_every,
        "steps between the samples of `null_space`, `uneven_pressure`, `torn_apart`, `swollen_load`, "
        "`looser_than_tested`, `early_contact` and `interpenetration`",
        true}}};
}

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
