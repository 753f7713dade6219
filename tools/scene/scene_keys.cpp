#include <fmt/core.h>

#include "tasks/scene.hpp"
#include "tools/scene/keys.hpp"

namespace tamp::tools
{

namespace
{

const ObjectKeys& grid_keys()
{
  constexpr int most_patches = 1'000'000;
  static const ObjectKeys keys{
      "",
      {{"lower", Numbers{per_axis}, "m", {0.0}, "lower corner of the domain"},
       {"upper", Numbers{per_axis}, "m", compulsory, "upper corner; each edge is a whole number of cells"},
       {"cell_size", Number{above_zero}, "m", compulsory, "edge of the cubic cells"},
       {"patches",
        WholeNumbers{per_axis, 1, most_patches},
        "",
        {1},
        "patches along each axis; each divides the cells there, into patches at least 3 cells wide"}}};
  return keys;
}

const ObjectKeys& wall_keys()
{
  static const ObjectKeys keys{
      "", {{"friction", Number{zero_or_above}, "", compulsory, "Coulomb's coefficient of friction"}}};
  return keys;
}

const ObjectKeys& boundary_keys()
{
  static const ObjectKeys keys = [] {
    ObjectKeys faces;
    for (const char axis : {'x', 'y', 'z'}) {
      for (const char side : {'-', '+'}) {
        faces.keys.push_back(choice<tasks::Face>(
            {axis, side}, tasks::Face::symmetry,
            {{"symmetry", tasks::Face::symmetry},
             {"open", tasks::Face::open},
             {"no_slip", tasks::Face::no_slip},
             {"periodic", tasks::Face::periodic}},
            "`\"symmetry\"`: a smooth wall, with the mirror image of the material behind it; `{\"friction\": MU}`: a "
            "wall that rubs, and that what touches it may leave, not where a centrifuge turns the grid; `\"no_slip\"`: "
            "a wall to which what touches it sticks; `\"open\"`: what crosses leaves the simulation; `\"periodic\"`, "
            "on both faces of an axis or on neither: what leaves at one enters at the other, see below",
            wall_keys, R"({"friction": MU})"));
        faces.keys.back().only_in = axis == 'z' ? 3 : 0;
      }
    }
    return faces;
  }();
  return keys;
}

const ObjectKeys& time_keys()
{
  constexpr tasks::SceneTime time{};
  static const ObjectKeys keys{
      "",
      {{"end", Number{above_zero}, "s", compulsory, "simulated time"},
       choice<tasks::StepRule>(
           "rule", time.rule, {{"viscous", tasks::StepRule::viscous}, {"published", tasks::StepRule::published}},
           "bound on the time step: `\"published\"` is cell size over (wave speed + fastest velocity component); "
           "`\"viscous\"` takes account of artificial viscosity, of particles at edges and alone, and of bodies that "
           "approach each other too, see [method.md](method.md)"),
       {"multiplier",
        Number{{.lower = 0, .upper = 1, .holds_lower = false}},
        "",
        {time.multiplier},
        "the part of that bound that is used, above 0 and up to 1"},
       {"minimum_step",
        Number{above_zero},
        "s",
        {time.minimum_step},
        "the run stops as unstable if its time step has to be shorter"},
       {"maximum_step", Number{above_zero}, "s", none, "longest time step"}}};
  return keys;
}

const ObjectKeys& viscosity_keys()
{
  constexpr components::ArtificialViscosity viscosity;
  static const ObjectKeys keys{
      "",
      {{"linear", Number{zero_or_above}, "", {viscosity.linear}, "its coefficient of the rate"},
       {"quadratic", Number{zero_or_above}, "", {viscosity.quadratic}, "its coefficient of the square of the rate"}}};
  return keys;
}

const ObjectKeys& output_keys()
{
  static const ObjectKeys keys{
      "",
      {{"fields_interval",
        Number{above_zero},
        "s",
        {nullptr, fmt::format("end / {}", usual_field_outputs)},
        "simulated time between field outputs"},
       {"history_interval",
        Number{above_zero},
        "s",
        {nullptr, fmt::format("end / {}", usual_history_rows)},
        "simulated time between rows of `history.csv`, whose columns are listed in [output.md](output.md)"},
       {"fields",
        SomeNames{},
        "",
        {nullptr, "all"},
        "a list of the fields that `fields.h5` has beside the ids and positions of particles: `\"velocity\"`, "
        "`\"stress\"`, `\"p\"`, `\"q\"`, `\"density\"`, `\"J\"`, what a material has of its own, such as "
        "`\"equivalent_plastic\"`, and of the grid's nodes `\"nodes/density\"` and `\"nodes/velocity\"`; `tamp check` "
        "lists all"},
       {"near_nose",
        Number{above_zero},
        "m",
        {tasks::SceneOutput{}.near_nose},
        "how far the surroundings of a nose reach"}}};
  return keys;
}

const ObjectKeys& limit_keys()
{
  static const ObjectKeys keys{
      "",
      {{"energy_error",
        Number{above_zero, "off"},
        "",
        {tasks::SceneLimits{}.energy_error},
        "a run whose total energy is wrong by more than this part of what it has been given (its initial energy and "
        "the work of gravity, of loads and of driving bodies) ends with exit code 3; every step is judged, unless a "
        "centrifuge speeds up; `\"off\"`: no limit"}}};
  return keys;
}

}  // namespace

const ObjectKeys& centrifuge_keys()
{
  static const ObjectKeys keys{
      "centrifuge",
      {{"angular_speed", Number{zero_or_above}, "rad/s", compulsory, "at the start, 0 or above"},
       {"axis", Numbers{just(3)}, "", compulsory,
        "direction of the axis, of any length above 0; positive rates turn with the right hand about it"},
       {"centre", Numbers{just(3)}, "m", compulsory, "a point of the axis"},
       {"angular_acceleration",
        Number{},
        "rad/s^2",
        {0.0},
        "constant; where it is not 0, the energy balance of `history.csv` lacks the work of the turning frame"}}};
  return keys;
}

const ObjectKeys& contact_keys()
{
  static const ObjectKeys keys{
      "contact",
      {{"materials", Names{just(2)}, "", compulsory, "A and B, names from `materials`"},
       {"friction", Number{zero_or_above}, "", compulsory, "Coulomb's coefficient of friction"},
       {"normal",
        Name{{flatter, regression}},
        "",
        {flatter},
        "whose surface gives the normal that both share: `\"flatter\"` takes the flatter one at each node, so that the "
        "edges of a block do not plough into the ground it slides on; A or B takes that material's, as suits a stiff "
        "body that is driven into a soft one; `\"regression\"` parts their particles by a plane at each node, whose "
        "normal jitters less, and lets them push each other only where they touch. Where three materials meet at a "
        "node, that of the flatter surface is taken there"}}};
  return keys;
}

const ObjectKeys& scene_keys()
{
  constexpr int many = 1'000'000'000;
  const Default empty{Json::object()};
  static const tasks::Scene scene{};
  static const ObjectKeys keys{
      .name = "scene",
      .keys =
          {{"title", Text{}, "", {nullptr, "the file's name"}, "one line for people"},
           {"dimension", WholeNumber{2, 3}, "", compulsory, "2 (plane strain) or 3"},
           {"grid", Object{grid_keys}, "", compulsory, ""},
           {"boundaries", Object{boundary_keys}, "", empty, ""},
           {"time", Object{time_keys}, "", compulsory, ""},
           choice<tasks::Interpolator>("interpolator", scene.interpolator, tasks::Interpolator::words(),
                                       "how far particles reach, and with what weights: " +
                                           meanings_of(tasks::Interpolator::words()) + "; see [method.md](method.md)"),
           choice<tasks::Transfer>(
               "transfer", scene.transfer,
               {{"flip", tasks::Transfer::flip},
                {"pic", tasks::Transfer::pic},
                {"blend", tasks::Transfer::blend},
                {"affine", tasks::Transfer::affine},
                {"apic", tasks::Transfer::apic},
                {"tpic", tasks::Transfer::tpic},
                {"xpic", tasks::Transfer::xpic},
                {"fmpm", tasks::Transfer::fmpm}},
               "how velocities go between particles and grid: with `\"flip\"` particles bring theirs to the grid and "
               "take the nodes' changes of them; with `\"affine\"` they bring their gradients too, so that bodies only "
               "a few cells thick turn as fast as they spin; with `\"pic\"` they take the nodes' velocities, "
               "`\"blend\"` "
               "is a part of each; `\"apic\"` and `\"tpic\"` are `\"pic\"` with gradients; `\"xpic\"` and `\"fmpm\"` "
               "filter only what the nodes cannot tell apart, the better the higher their order; see "
               "[method.md](method.md)"),
           {"flip_part",
            Number{{.lower = 0, .upper = 1}},
            "",
            {scene.flip_part},
            "with `\"blend\"` only: the part of `\"flip\"`, from 0 to 1; the rest is `\"pic\"`"},
           {"filter_order",
            WholeNumber{1, 100},
            "",
            {scene.filter_order},
            "with `\"xpic\"` and `\"fmpm\"` only: their order; 1 is `\"pic\"`, and each one more takes another "
            "pass over the particles"},
           choice<tasks::DeformationUpdate>(
               "deformation_update", scene.deformation_update,
               {{"exact", tasks::DeformationUpdate::exact},
                {"first_order", tasks::DeformationUpdate::first_order},
                {"exponential", tasks::DeformationUpdate::exponential}},
               "how particles deform in a step, by g = dt times the velocity gradient: `\"exact\"`, by 1 + g, with a "
               "strain free of rotations; `\"first_order\"`, by 1 + g, with the symmetric part of g for strain, as "
               "published codes have it; `\"exponential\"`, by exp(g), which turns nothing inside out; see "
               "[method.md](method.md)"),
           choice<tasks::Relief>("relief", scene.relief,
                                 {{"none", tasks::Relief::none},
                                  {"cell_average", tasks::Relief::cell_average},
                                  {"f_bar", tasks::Relief::f_bar}},
                                 "from locking, by sharing changes of volume: with `\"cell_average\"` all particles of "
                                 "a material in a cell take their mean, with `\"f_bar\"` that at the "
                                 "centre of the cell; see [method.md](method.md)"),
           choice<tasks::StressTiming>(
               "stress_timing", scene.stress_timing,
               {{"usl", tasks::StressTiming::usl},
                {"usf", tasks::StressTiming::usf},
                {"musl", tasks::StressTiming::musl}},
               "when stress follows the motion, and which velocities of the nodes deform particles: `\"usl\"`, last, "
               "by those that move particles; `\"usf\"`, first, by those that particles bring; `\"musl\"`, last, by "
               "those that particles bring back to the nodes with their new velocities; see [method.md](method.md). "
               "`\"usf\"` is not for `\"affine\"` with sand that `comes_apart`"),
           {"particles_per_cell",
            WholeNumbers{per_axis, 1, most_particles_per_axis},
            "",
            {scene.particles_per_axis},
            fmt::format("particles along each axis of a cell, the same number along all, at most {}",
                        most_particles_per_axis)},
           {"gravity", Numbers{per_axis}, "m/s^2", {0.0}, "acceleration of free fall"},
           {"centrifuge",
            Object{centrifuge_keys},
            "",
            {nullptr, "off"},
            "an object: the grid turns about an axis fixed in space; three dimensions only, see below"},
           {"artificial_viscosity",
            Object{viscosity_keys},
            "",
            {nullptr, "off"},
            "an object, which may be empty: pressure in compression that damps shocks"},
           {"local_damping",
            Number{{.lower = 0, .upper = 1, .holds_upper = false}},
            "",
            {scene.local_damping},
            "part of the unbalanced force of every node of the grid that works against its motion, from 0 to below 1: "
            "for scenes that are to come to rest under pressure loads or their own weight, not for bodies driven into "
            "others or for impact; what it "
            "takes counts as `viscous[J]`"},
           {"materials", Members{material_keys}, "", compulsory,
            "an object: name → material, see below; materials are what contact is between"},
           {"bodies", Members{body_keys}, "", compulsory, "an object: name → body, see below; bodies do not overlap"},
           {"contact",
            Objects{contact_keys},
            "",
            {Json::array()},
            "a list of objects, see below; pairs of materials that are not listed slide without friction"},
           {"failed_updates_allowed",
            WholeNumber{0, many},
            "",
            {scene.failed_updates_allowed},
            "stress updates that may fail in a run before it stops with exit code 3; a particle whose update fails "
            "keeps its stress; one of a tabular cap is marked in the field `failed_updates`"},
           {"output", Object{output_keys}, "", empty, ""},
           {"limits", Object{limit_keys}, "", empty, ""},
           {"inputs",
            Anything{},
            "",
            {},
            "the files that were read, with a hash of each, which a resolved scene lists; in a scene that is read it "
            "is passed over"}},
      .may_be_a_file = true};
  return keys;
}

}  // namespace tamp::tools
