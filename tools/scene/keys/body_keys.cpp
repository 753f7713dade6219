#include <fmt/format.h>
#include <fmt/ranges.h>

#include "components/problems/problem.hpp"
#include "tasks/scene_body.hpp"
#include "tasks/set_up/settled_ground.hpp"
#include "tools/scene/json/keys.hpp"
#include "tools/scene/json/parameter_keys.hpp"

namespace tamp::tools
{

namespace
{

template <class P>
TypeKeys problem_type()
{
  return {std::string(P::type), keys_of_parameters<P>(), std::string(P::meaning)};
}

template <class... P>
std::vector<TypeKeys> problem_types(const std::variant<P...>*)
{
  return {problem_type<P>()...};
}

}  // namespace

const ObjectKeys& drive_keys()
{
  static const ObjectKeys keys{
      "driven_body",
      {{"velocity", Numbers{per_axis}, "m/s", {}, "of its centre of mass, constant"},
       {"velocities",
        Rows{time_and_axes},
        "s, m/s",
        {},
        "the same as a list of `[time, vx, vy]` (in three dimensions `[time, vx, vy, vz]`), with straight lines "
        "between; constant before the first and after the last"},
       {"displacements",
        Rows{time_and_axes},
        "s, m",
        {},
        "from its start, as a list of `[time, ux, uy]`, the first with zeros; at rest before the first and after the "
        "last"},
       choice<bool>("rotation", false, {{"held", false}, {"free", true}},
                    "`\"held\"`: it never turns; `\"free\"`: it is turned by what it touches")}};
  return keys;
}

const ObjectKeys& pressed_box_keys()
{
  static const std::string corners =
      "corners of a box: only the part of the surface whose matter starts in it is pressed, and stays so as it moves";
  static const ObjectKeys keys{"",
                               {{"lower", Numbers{per_axis}, "m", {nullptr, "all", true}, corners},
                                {"upper", Numbers{per_axis}, "m", {nullptr, "all", true}, corners}}};
  return keys;
}

const ObjectKeys& pressure_keys()
{
  static const ObjectKeys keys{
      "pressure",
      {{"value", Number{zero_or_above}, "Pa", {}, "the pressure, constant; 0 or above, compression positive"},
       {"values",
        Rows{just(2)},
        "s, Pa",
        {},
        "the same against time as a list of `[time, pressure]`, with straight lines between; constant before the first "
        "and after the last"},
       {"within", Object{pressed_box_keys}, "", none, ""}}};
  return keys;
}

const ObjectKeys& problem_keys()
{
  static const ObjectKeys keys{
      .name = "problem", .keys = {}, .types = problem_types(static_cast<const components::Problem*>(nullptr))};
  return keys;
}

const ObjectKeys& body_keys()
{
  static const std::string ends =
      "the ends of a long body at the start; both or neither, within the body or on its surface. `history.csv` then "
      "follows them, the angle of the axis below the horizontal (the last axis being vertical), and the peaks of each "
      "material near the nose";
  static const std::string settled = fmt::format(
      "soil ({}) that has settled under `gravity` and `centrifuge` and is at rest: a box, not rigid and without "
      "velocity, whose floor and sides lie on walls and whose top is free, or several such boxes, one on another; the "
      "axis of a centrifuge is then along x, y or z, and its speed constant",
      fmt::join(tasks::settling_types(), ", "));
  static const ObjectKeys keys{
      "body",
      {{"material", Name{}, "", compulsory, "a name from `materials`"},
       {"geometry", Object{solid_keys}, "", compulsory, "the region it fills at the start, within the grid"},
       choice<tasks::ParticleLayout>(
           "particles", tasks::ParticleLayout::lattice,
           {{"lattice", tasks::ParticleLayout::lattice},
            {"cut", tasks::ParticleLayout::cut},
            {"rings", tasks::ParticleLayout::rings}},
           "`\"lattice\"`: at the sites of the lattice within the geometry; `\"cut\"`: those whose share of their cell "
           "the outline cuts have the volume and the middle of what lies within, so that the body weighs what it "
           "should "
           "and its edge has no steps; `\"rings\"`, of a `\"ball\"` in the plane, or about the axis: on rings about "
           "its "
           "centre, as those of the problem `\"rotating_disk\"`, so that it is round enough to roll or to bounce"),
       {"velocity", Numbers{per_axis}, "m/s", {0.0}, "at the start"},
       {"angular_velocity",
        Numbers{per_rotation},
        "rad/s",
        {0.0},
        "at the start, about the centre of mass; in two dimensions a list of one number"},
       {"rigid",
        Flag{},
        "",
        {false},
        "the body keeps its shape and does not bound the time step by its stiffness; its material is then no other "
        "body's, and needs moduli only for runs in which it is not rigid"},
       {"driven", Object{drive_keys}, "", none,
        "an object: the prescribed motion of a rigid body, see below; without `velocity`, and without "
        "`angular_velocity` unless its rotation is free"},
       {"nose", Numbers{per_axis}, "m", none, ends},
       {"tail", Numbers{per_axis}, "m", none, ends},
       {"initial_stress", Flag{}, "", {false}, settled},
       {"k0",
        Number{above_zero},
        "",
        {nullptr, "ν / (1 - ν); 1 - sin(`critical_friction_angle`) of `bolton_sand`"},
        "with `initial_stress`, the horizontal over the vertical stress; by default that of an elastic layer that "
        "cannot widen, and of Bolton's sand that of Jaky (1944)"},
       {"pressure", Object{pressure_keys}, "", none,
        "an object: a pressure on the surface of a body that is not rigid, see below"},
       {"problem", Object{problem_keys}, "", none,
        "an object: the body starts and is driven by functions of place and time, see below; not of a rigid body, and "
        "not with `initial_stress`"}}};
  return keys;
}

}  // namespace tamp::tools
