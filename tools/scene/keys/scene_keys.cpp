#include <fmt/core.h>

#include "tasks/scene.hpp"
#include "tools/scene/json/keys.hpp"
#include "tools/scene/json/parameter_keys.hpp"

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

const ObjectKeys& boundary_keys()
{
  static const ObjectKeys keys = [] {
    const KindKeys kinds = keys_of_kinds<tasks::Face>();
    ObjectKeys faces;
    for (const char axis : {'x', 'y', 'z'}) {
      for (const char side : {'-', '+'}) {
        faces.keys.push_back(choice<int>({axis, side}, 0, kinds.words, kinds.meanings, kinds.objects));
        faces.keys.back().only_in = axis == 'z' ? 3 : 0;
      }
    }
    return faces;
  }();
  return keys;
}

const ObjectKeys& time_keys()
{
  static const ObjectKeys keys = [] {
    ObjectKeys time{"", keys_of_parameters<tasks::SceneTime>()};
    const std::vector<components::Word<tasks::StepRule>> rules{
        {"published", tasks::StepRule::published, "cell size over (wave speed + fastest velocity component)"},
        {"viscous", tasks::StepRule::viscous,
         "takes account of artificial viscosity, of particles at edges and alone, and of bodies that approach each "
         "other too"}};
    const Key rule = choice<tasks::StepRule>(
        "rule", tasks::SceneTime{}.rule, rules,
        "bound on the time step: " + meanings_of(rules) + ", see [method.md](../explanation/method.md)");
    time.keys.insert(time.keys.begin() + 1, rule);
    return time;
  }();
  return keys;
}

const ObjectKeys& viscosity_keys()
{
  static const ObjectKeys keys{"", keys_of_parameters<components::ArtificialViscosity>()};
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
        "`\"equivalent_plastic\"`, and of the grid's nodes `\"nodes/density\"` and `\"nodes/velocity\"`; `tamp check "
        "--json` lists all"},
       {"near_nose",
        Number{above_zero},
        "m",
        {tasks::SceneOutput{}.near_nose},
        "how far the surroundings of a nose reach"}}};
  return keys;
}

const ObjectKeys& limit_keys()
{
  static const ObjectKeys keys = [] {
    ObjectKeys limits{"", keys_of_parameters<tasks::SceneLimits>()};
    limits.keys.insert(
        limits.keys.begin(),
        {"energy_error",
         Number{above_zero, "off"},
         "",
         {tasks::SceneLimits{}.energy_error},
         "a run whose total energy is wrong by more than this part of what it has been given (its initial energy and "
         "the work of gravity, of loads and of driving bodies) ends with exit code 3; every step is judged, unless a "
         "centrifuge speeds up; `\"off\"`: no limit"});
    return limits;
  }();
  return keys;
}

std::vector<Key> domain_keys()
{
  const Default empty{Json::object()};
  return {{"title", Text{}, "", {nullptr, "the file's name"}, "one line for people"},
          {"dimension", WholeNumber{2, 3}, "", compulsory, "2 (plane strain, or axisymmetric) or 3"},
          {"axisymmetric",
           Flag{},
           "",
           {false},
           "with dimension 2: the scene is the section of a body of revolution about the line x = 0; x is the distance "
           "from that line, y runs along it, and masses, forces and energies are those of the whole; see "
           "[method.md](../explanation/method.md)"},
          {"grid", Object{grid_keys}, "", compulsory, ""},
          {"boundaries", Object{boundary_keys}, "", empty, ""},
          {"time", Object{time_keys}, "", compulsory, ""}};
}

/// The ways in which a step is made.
std::vector<Key> method_keys()
{
  static const tasks::Scene scene{};
  const std::string see = "; see [method.md](../explanation/method.md)";
  const auto words = [&see](auto value) { return meanings_of(words_of(value)) + see; };
  std::vector<Key> keys{
      choice("interpolator", scene.interpolator, tasks::Interpolator::words(),
             "how far particles reach, and with what weights: " + meanings_of(tasks::Interpolator::words()) + see),
      choice("transfer", scene.transfer, tasks::Transfer::words(),
             "how velocities go between particles and grid: " + meanings_of(tasks::Transfer::words()) + see)};
  for (Key& number : keys_of_parameters<components::TransferNumbers>()) keys.push_back(std::move(number));
  keys.push_back(choice("deformation_update", scene.deformation_update, tasks::DeformationUpdate::words(),
                        "how particles deform in a step, by g = dt times the velocity gradient: " +
                            meanings_of(tasks::DeformationUpdate::words()) + see));
  keys.push_back(choice("anti_locking", scene.anti_locking, words_of(scene.anti_locking),
                        "against locking, by sharing changes of volume: " + words(scene.anti_locking)));
  keys.back().old_name = "relief";
  keys.push_back(choice("stress_timing", scene.stress_timing, words_of(scene.stress_timing),
                        "when stress follows the motion, and which velocities of the nodes deform particles: " +
                            words(scene.stress_timing)));
  return keys;
}

std::vector<Key> load_keys()
{
  static const tasks::Scene scene{};
  return {{"particles_per_cell",
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
           "part of the unbalanced force at every node that acts against its motion, from 0 to below 1: for scenes "
           "that are to come to rest, or are pressed slowly, not for flight, sliding or impact; the energy that it "
           "takes counts as `viscous[J]`"}};
}

std::vector<Key> content_keys()
{
  constexpr int many = 1'000'000'000;
  const Default empty{Json::object()};
  return {{"materials", Members{material_keys}, "", compulsory,
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
           {tasks::Scene{}.failed_updates_allowed},
           "stress updates that may fail in a run before it stops with exit code 3; a particle whose update fails "
           "keeps its stress; one of a tabular cap is marked in the field `failed_updates`"},
          {"output", Object{output_keys}, "", empty, ""},
          {"limits", Object{limit_keys}, "", empty, ""},
          {"inputs",
           Anything{},
           "",
           {},
           "the files that were read, with a hash of each, which a resolved scene lists; in a scene that is read it "
           "is passed over"}};
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
  static const ObjectKeys keys = [] {
    const KindKeys kinds = keys_of_kinds<components::ContactNormal>();
    Name normal{{}, kinds.objects};
    for (const auto& word : kinds.words) normal.words.emplace_back(word.word);
    return ObjectKeys{"contact",
                      {{"materials", Names{just(2)}, "", compulsory, "A and B, names from `materials`"},
                       {"friction", Number{zero_or_above}, "", compulsory, "Coulomb's coefficient of friction"},
                       {"normal",
                        std::move(normal),
                        "",
                        {nullptr,
                         "`\"regression\"`, or `\"flatter\"` between periodic boundaries and between two materials "
                         "with `initial_stress`"},
                        "which normal both share: " + kinds.meanings}}};
  }();
  return keys;
}

const ObjectKeys& scene_keys()
{
  static const ObjectKeys keys = [] {
    ObjectKeys scene{.name = "scene", .keys = {}, .may_be_a_file = true};
    for (const auto& keys_of : {domain_keys, method_keys, load_keys, content_keys}) {
      for (Key& key : keys_of()) scene.keys.push_back(std::move(key));
    }
    return scene;
  }();
  return keys;
}

}  // namespace tamp::tools
