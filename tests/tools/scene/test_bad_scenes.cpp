#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <string_view>

#include "tests/tools/scene/small_scene.hpp"

namespace test_bad_scenes
{

using namespace tamp::test;

namespace
{

/// A change of a good scene, and what is said of it then: nothing, if it is still good. The change is assignments as
/// --set has them, with spaces between and ' for ". A message that begins with a pointer is one of --set; * stands for
/// any text.
struct Row {
  std::string change;
  std::string message;
};

std::vector<std::string> assignments_of(std::string change)
{
  std::replace(change.begin(), change.end(), '\'', '"');
  std::vector<std::string> assignments;
  for (std::size_t start = 0, end = 0; end < change.size(); start = end + 1) {
    end = std::min(change.find(" /", start), change.size());
    assignments.push_back(change.substr(start, end - start));
  }
  return assignments;
}

bool is_like(std::string_view text, std::string_view pattern)
{
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return text == pattern;
  if (text.substr(0, star) != pattern.substr(0, star)) return false;
  for (std::size_t end = star; end <= text.size(); ++end) {
    if (is_like(text.substr(end), pattern.substr(star + 1))) return true;
  }
  return false;
}

/// Problems of a good scene after some assignments.
using GoodScene = std::function<std::string(const std::vector<std::string>&)>;

GoodScene shipped(const std::string& file)
{
  return [file](const std::vector<std::string>& assignments) {
    return problems_of(TemporaryFolder(), TAMP_SOURCE_DIR "/inputs/" + file, assignments);
  };
}

/// Makes each change after those that all rows have in common.
void check(const GoodScene& problems_with, const std::string& common, const std::vector<Row>& rows)
{
  for (const auto& [change, message] : rows) {
    std::vector<std::string> assignments = assignments_of(common);
    for (std::string& assignment : assignments_of(change)) assignments.push_back(std::move(assignment));

    const std::string found = problems_with(assignments);

    const std::string expected = (message.rfind('/', 0) == 0 ? "--set#" : "") + message;
    INFO("change:   " << change << "\nfound:    " << found << "\nexpected: " << expected);
    CHECK(is_like(found, expected));
  }
}
void check(const GoodScene& problems_with, const std::vector<Row>& rows)
{
  check(problems_with, "", rows);
}

}  // namespace

TEST_CASE("keys that are missing or unknown are refused, and values of a wrong type or out of range")
{
  const std::string pointer = ": not an assignment; expected /POINTER=VALUE, such as /grid/cell_size=0.01";

  check(problems_with,
        {{"", ""},
         {"/grid/cell_size=null", "/grid/cell_size: missing; expected a number above 0 [m]"},
         {"/grid/cellsize=1", "/grid/cellsize: unknown key; did you mean \"cell_size\"?"},
         {"/artificial_viscosity/bulk=1", "/artificial_viscosity/bulk: unknown key; expected one of linear, quadratic"},
         {"/time/end=NaN", "/time/end: \"NaN\"; expected a number above 0 [s]"},
         {"/time/end=[1]", "/time/end: [1]; expected a number above 0 [s]"},
         {"/dimension=2.5", "/dimension: 2.5; expected a whole number from 2 to 3"},
         {"/boundaries=[]", "/boundaries: []; expected an object"},
         {"/title=3", "/title: 3; expected a text"},
         {"/gravity=[0]", "/gravity: [0]; expected 2 numbers"},
         {"/contact={}", "/contact: an object; expected a list"},
         {"/contact=[1]", "/contact/0: 1; expected an object"},
         {"grid/cell_size=1", "--set grid/cell_size=1" + pointer},
         {"/grid", "--set /grid" + pointer},
         {"/dimension/x=1",
          "--set /dimension/x=1: there is no such place in the scene; expected a pointer to a key or to an item"}});
}

TEST_CASE("a grid that is no whole number of cells, or not divided by its patches, is refused")
{
  const std::string whole = "; expected the grid's edges to be whole numbers of cells";

  check(problems_with,
        {{"/grid/cell_size=0.3", "/grid/cell_size: 6.666666667 cells along x" + whole +
                                     "\n--set#/grid/cell_size: 6.666666667 cells along y" + whole},
         {"/grid/upper=[0,2]", "*#/grid/upper: 0 cells along x; expected 1 to*"},
         {"/grid/patches=[1,3]", "/grid/patches: 3 patches along y; expected a number that divides the 2 cells there"},
         {"/grid/cell_size=0.25 /grid/patches=[2,1]", ""},
         {"/grid/cell_size=0.25 /grid/patches=[2,4]",
          "/grid/patches: 4 patches along y, 2 cells wide; expected patches at least 3 cells wide along an axis that "
          "is cut"},
         {"/particles_per_cell=[0,0]", "/particles_per_cell: [0,0]; expected 2 whole numbers from 1 to 16"},
         {"/particles_per_cell=[2,3]",
          "/particles_per_cell: unequal numbers; expected the same number along every axis"}});
}

TEST_CASE("time steps out of range are refused")
{
  check(problems_with,
        {{"/time/multiplier=101", "/time/multiplier: 101; expected a number above 0 and up to 100"},
         {"/time/multiplier=100", ""},
         {"/time/multiplier=0", "/time/multiplier: 0; expected a number above 0 and up to 100"},
         {"/time/maximum_step=1e-13", "/time/maximum_step: 1e-13; expected no less than the minimum step, 1e-12"}});
}

TEST_CASE("a method that is none of the choices, or does not go with another choice, is refused")
{
  const std::string energy = "; expected another transfer, as particles would gain energy where the wall stops nodes";

  check(problems_with,
        {{"/interpolator=quintic_spline",
          "/interpolator: \"quintic_spline\"; expected one of linear, gimp, cpgimp, cpdi, quadratic_spline, "
          "cubic_spline, did you mean \"quadratic_spline\"?"},
         {"/interpolator=linear",
          "/interpolator: \"linear\" with the time step's rule \"viscous\"; expected the rule \"published\", as a "
          "particle that hardly reaches a node would have no stable step; or another interpolator"},
         {"/transfer=mpm",
          "/transfer: \"mpm\"; expected one of flip, pic, blend, tflip, apic, tpic, xpic, fmpm, did you mean "
          "\"fmpm\"?"},
         {"/flip_part=0.9", "/flip_part: a key that another transfer has; expected the transfer blend with it"},
         {"/transfer=blend /filter_order=2",
          "/filter_order: a key that another transfer has; expected the transfer xpic or fmpm with it"},
         {"/transfer=blend /flip_part=1.5", "/flip_part: 1.5; expected a number from 0 to 1"},
         {"/transfer=fmpm /filter_order=101", "/filter_order: 101; expected a whole number from 1 to 100"},
         {"/transfer=xpic /filter_order=12", ""},
         {"/transfer=apic", ""},
         {"/transfer=apic /interpolator=linear /time/rule=published",
          "/transfer: apic with an interpolator whose weights have no spread where a particle is on a node; expected "
          "another transfer, such as tpic, or another interpolator"},
         {"/transfer=fmpm /boundaries/y-/friction=0.3", "/transfer: fmpm of order 2 with a wall that rubs" + energy},
         {"/transfer=fmpm /filter_order=1 /boundaries/y-/friction=0.3", ""}});
}

TEST_CASE("FMPM where contact would give particles energy is refused")
{
  const std::string not_met = "/transfer: fmpm of order 2 with materials that do not meet*";

  check(problems_with,
        "/materials/soil={'type':'hypoelastic','density':1,'bulk_modulus':1,'shear_modulus':1} "
        "/bodies/other={'material':'soil','geometry':{'type':'box','lower':[0,1],'upper':[1,2]}} /transfer=fmpm",
        {{"", ""},
         {"/contact=[{'materials':['steel','soil'],'friction':0}]", ""},
         {"/contact=[{'materials':['steel','soil'],'friction':0,'normal':'flatter'}]", not_met},
         {"/contact=[{'materials':['steel','soil'],'friction':0,'normal':'steel'}]", not_met}});
}

TEST_CASE("sand that has to forget its gradients is not updated before it has them")
{
  check(shipped("punch/quick.json"),
        {{"/transfer=tflip /stress_timing=usf /materials/sand/separation=true",
          "/stress_timing: \"usf\" with the transfer tflip and sand that separates, \"sand\"; expected usl or musl, "
          "as sand that is apart has to forget the gradient of its velocity, which with usf it only gets after its "
          "stress; or another transfer"},
         {"/transfer=tflip /stress_timing=usf", ""},
         {"/stress_timing=usf /materials/sand/separation=true", ""},
         {"/transfer=tflip /stress_timing=musl /materials/sand/separation=true", ""}});
}

TEST_CASE("a wall has a word or a coefficient of friction, and periodic faces come in pairs")
{
  const std::string words = "; expected one of symmetry, open, no_slip, periodic, {\"friction\": MU}";
  const std::string pair =
      ": a face that is not periodic, opposite to one that is; expected both faces of an axis periodic, or neither";

  check(problems_with, {{"/boundaries/y-=no_slip", ""},
                        {"/boundaries/y-={'friction':0.4}", ""},
                        {"/boundaries/x-=wall", "/boundaries/x-: \"wall\"" + words},
                        {"/boundaries/y-=rough", "/boundaries/y-: \"rough\"" + words},
                        {"/boundaries/y-={'friction':-0.4}", "/boundaries/y-/friction: -0.4; expected a number*"},
                        {"/boundaries/y-={}", "*#/boundaries/y-/friction: missing*"},
                        {"/boundaries/y-={'friction':0.4,'slip':1}", "*#/boundaries/y-/slip: unknown key*"},
                        {"/grid/upper=[3,2] /boundaries={'x-':'periodic','x+':'periodic'}", ""},
                        {"/boundaries={'x+':'periodic'}", "/boundaries/x-" + pair},
                        {"/boundaries={'y-':'periodic','y+':{'friction':0.4}}", "/boundaries/y+" + pair},
                        {"/boundaries={'x-':'periodic','x+':'periodic'}",
                         "/boundaries/x-: periodic, 2 cells along x; expected at least 3 cells between periodic faces"},
                        {"/boundaries={'z-':'periodic','z+':'periodic'}", "*#/boundaries/z-: unknown key*"}});
}

TEST_CASE("what cannot go around is refused between periodic faces")
{
  check(problems_with,
        "/grid/upper=[9,9] /bodies/block/geometry/lower=[2,2] /bodies/block/geometry/upper=[5,5] "
        "/boundaries={'y-':'periodic','y+':'periodic'}",
        {{"/bodies/block/velocity=[0,1]", ""},
         {"/bodies/block/rigid=true",
          "/bodies/block/rigid: a rigid body, which cannot go around, between periodic boundaries; expected one that "
          "is not rigid, or other boundaries"},
         {"/bodies/block/nose=[3,2] /bodies/block/tail=[3,5]",
          "/bodies/block/nose: a nose, whose surroundings cannot go around, between periodic boundaries; expected "
          "none, or other boundaries"}});
  check(problems_with_sand,
        {{"/grid/upper=[3,2] /boundaries={'x-':'periodic','x+':'periodic'} "
          "/contact=[{'materials':['steel','sand'],'friction':0,'normal':'regression'}]",
          "/contact/0/normal: regression, whose planes have one place each, between periodic boundaries; expected "
          "another normal"}});
}

TEST_CASE("a centrifuge whose numbers make no rotation, or that turns what cannot turn, is refused")
{
  const std::string turning = "/centrifuge={'angular_speed':1,'axis':[1,0,0],'centre':[0,0,0]}";

  check(problems_with,
        {{"/centrifuge={'angular_speed':6}", "/centrifuge: a plane scene; expected one of dimension 3"}});
  check(problems_with,
        "/dimension=3 /grid/upper=[3,2,2] /bodies/block/geometry={'type':'box','lower':[0,0,0],'upper':[1,1,1]}",
        {{"/centrifuge={'angular_speed':6,'axis':[1,0,0],'centre':[0,0,5]}", ""},
         {"/centrifuge={'angular_speed':6,'axis':[0,0,0],'centre':[0,0,5]}",
          "/centrifuge/axis: an axis of zero length; expected a direction"},
         {"/centrifuge={'angular_speed':-6,'axis':[1,0,0],'centre':[0,0,5]}",
          "/centrifuge/angular_speed: -6; expected a number of 0 or above [rad/s]"},
         {"/centrifuge={'angular_speed':6,'axis':['NaN',0,0],'centre':[0,0,5]}", "/centrifuge/axis*"},
         {"/boundaries={'x-':{'friction':0.4},'z-':{'friction':0.4}}", ""},
         {"/boundaries={'x-':{'friction':0.4},'z-':{'friction':0.4}} " + turning,
          "/centrifuge: a wall with friction; expected other boundaries where the grid turns"},
         {"/boundaries={'x-':'periodic','x+':'periodic'} " + turning,
          "/centrifuge: periodic boundaries, whose ends are not alike in a turning grid; expected other boundaries "
          "where the grid turns"}});
}

TEST_CASE("local damping is a part of a force")
{
  check(problems_with, {{"/local_damping=0.3", ""},
                        {"/local_damping=1", "/local_damping: 1; expected a number*"},
                        {"/local_damping=-0.1", "/local_damping: -0.1; expected a number*"}});
}

TEST_CASE("a pressure load pushes on a surface of a body that is not rigid")
{
  // The block of 1 m x 1 m lies against walls on its left and below it.
  const std::string pressure = "/bodies/block/pressure", load = pressure + "=";
  const std::string surface = "; expected a box that holds some of the body's surface";

  check(problems_with,
        {{load + "{'value':1e3}", ""},
         {load + "{'values':[[0,0],[1,1e3]],'within':{'lower':[-1,0.99],'upper':[1,2]}}", ""},
         {load + "null", ""},
         {load + "1000", pressure + ": 1000; expected an object"},
         {load + "{}", pressure + "/value: neither value nor values; expected one of value and values"},
         {load + "{'value':1,'values':[[0,1]]}", pressure + "/value: beside values; expected one of value and values"},
         {load + "{'value':-1}", pressure + "/value: -1; expected a number of 0 or above [Pa]"},
         {load + "{'value':'much'}", pressure + "/value: \"much\"; expected a number of 0 or above [Pa]"},
         {load + "{'values':[[0,1],[0,2]]}",
          pressure + "/values: entry 1: 0.000000 s after 0.000000 s; expected times that ascend"},
         {load + "{'values':[[0,1],[1,-2]]}",
          pressure + "/values: entry 1: -2.000000 Pa; expected a pressure of 0 or above"},
         {load + "{'values':[]}", pressure + "/values: no point; expected one or more"},
         {load + "{'values':[[0,1,2]]}", "*expected a list of lists of 2 numbers*"},
         {load + "{'value':1,'within':{'lower':[0,0],'upper':[1,0]}}",
          pressure + "/within/upper: 0 along y; expected more than lower, 0"},
         {load + "{'value':1,'within':{'lower':[0,0]}}", pressure + "/within/upper: missing*"},
         {load + "{'value':1,'side':'top'}", pressure + "/side: unknown key*"},
         {load + "{'value':1,'within':{'lower':[5,5],'upper':[6,6]}}",
          pressure + "/within: from [5, 5] to [6, 6]" + surface},
         {load + "{'value':1,'within':{'lower':[0.1,0.1],'upper':[0.9,0.9]}}",
          pressure + "/within: from [0.1, 0.1] to [0.9, 0.9]" + surface},
         // A wall is no surface, but an open face is.
         {load + "{'value':1,'within':{'lower':[-1,-1],'upper':[0.1,0.9]}}",
          pressure + "/within: from [-1, -1] to [0.1, 0.9]" + surface},
         {load + "{'value':1,'within':{'lower':[-1,-1],'upper':[0.1,0.9]}} /boundaries/x-=open", ""},
         {load + "{'value':1} /bodies/block/geometry/upper=[2,2]",
          pressure + ": a body without a surface, between walls; expected one with a free side"},
         {load + "{'value':1} /grid/upper=[9,9] /bodies/block/geometry/lower=[2,2] "
                 "/bodies/block/geometry/upper=[3,3] /bodies/block/rigid=true",
          pressure + ": a rigid body, which bears no stress; expected one that is not rigid"}});
}

TEST_CASE("a material of no type, or whose numbers do not go together, is refused")
{
  check(problems_with,
        {{"/materials/steel/type=hypoelastik",
          "/materials/steel/type: \"hypoelastik\"; expected one of hypoelastic, neo_hookean, neo_hookean_log, "
          "drucker_prager, tabular_cap, did you mean \"hypoelastic\"?"},
         {"/materials/steel/density=-8000", "/materials/steel/density: -8000; expected a number above 0 [kg/m^3]"},
         {"/materials/steel/particles_per_axis=2.5",
          "/materials/steel/particles_per_axis: 2.5; expected a whole number from 1 to 16"},
         {"/materials/steel/particles_per_axis=0",
          "/materials/steel/particles_per_axis: 0; expected a whole number from 1 to 16"}});
  for (const std::string type : {"hypoelastic", "neo_hookean", "neo_hookean_log"}) {
    check(
        problems_with, "/materials/steel/type=" + type,
        {{"/materials/steel/bulk_modulus=0", "/materials/steel/bulk_modulus: 0; expected a number above 0 [Pa]"},
         {"/materials/steel/shear_modulus=-1", "/materials/steel/shear_modulus: -1; expected a number above 0 [Pa]"}});
  }
}

TEST_CASE("soil whose numbers do not go together is refused, with the one that does not")
{
  const std::string soil = "/materials/steel", friction = soil + "/friction_angle=30 ";

  check(problems_with, soil + "={'type':'drucker_prager','density':1600,'bulk_modulus':1e7,'shear_modulus':1e7}",
        {{friction, ""},
         {"", "*#/materials/steel/friction_angle: missing; expected a number from 0 to below 90 [degrees]"},
         {friction + soil + "/dilation_angle=31",
          soil + "/dilation_angle: 31; expected at most the friction angle, 30: more would gain energy by flowing"},
         {friction + soil + "/cohesion=1e4 /materials/steel/tension_cutoff=2e4",
          soil + "/tension_cutoff: 20000; expected at most 17320.5 Pa, where the cone ends"},
         {friction + soil + "/cohesion=much", soil + "/cohesion: \"much\"; expected a number of 0 or above [Pa]"}});
}

TEST_CASE("sand that separates at no density, or perhaps, is refused")
{
  check(shipped("punch/quick.json"),
        {{"/materials/sand/separation=true", ""},
         {"/materials/sand/separation_density=1", ""},
         {"/materials/sand/separation=perhaps", "/materials/sand/separation: \"perhaps\"; expected true or false"},
         {"/materials/sand/separation_density=0",
          "/materials/sand/separation_density: 0; expected a number above 0 and up to 1"}});
}

TEST_CASE("contact of a material with itself, with an unknown one, or given twice is refused")
{
  check(problems_with, {{"/contact=[{'materials':['steel','steel'],'friction':0}]",
                         "/contact/0/materials: \"steel\" twice; expected two different materials"},
                        {"/contact=[{'materials':['steel','snd'],'friction':0}]",
                         "/contact/0/materials: \"snd\"; expected 2 of steel"}});
  check(problems_with_sand,
        {{"/contact=[{'materials':['steel','sand'],'friction':0},{'materials':['sand','steel'],'friction':0}]",
          "/contact/1/materials: a pair that is listed before; expected every pair once"},
         {"/contact=[{'materials':['steel','sand'],'friction':-0.1}]",
          "/contact/0/friction: -0.1; expected a number of 0 or above"}});
}

TEST_CASE("the normal of a contact is a material's or a word, which no material is named by")
{
  const std::string contact = "/contact=[{'materials':['steel','sand'],'friction':0,'normal':";
  const std::string iron = "={'type':'hypoelastic','density':8000,'bulk_modulus':1e10,'shear_modulus':7e9}";
  const std::string word = ": a word of the contact key normal; expected another name";

  check(problems_with_sand,
        {{"", ""},
         {contact + "'sand'}]", ""},
         {contact + "'snd'}]",
          "/contact/0/normal: \"snd\"; expected one of flatter, regression, steel, sand, did you mean \"sand\"?"},
         {contact + "1}]", "/contact/0/normal: 1; expected one of flatter, regression, steel, sand"}});
  check(problems_with, {{"/materials/flatter" + iron, "/materials/flatter" + word},
                        {"/materials/regression" + iron, "/materials/regression" + word},
                        {"/materials/flattest" + iron, ""}});
}

TEST_CASE("bodies that hold nothing, leave the grid or overlap are refused")
{
  const std::string geometry = "scene.json#/bodies/block/geometry: ";
  const std::string within_or_cut =
      "; expected it to lie within the grid, or to be cut in halves by a \"symmetry\" face";
  const std::string overlap = "/bodies/second: overlaps body \"block\", at ";
  const std::string second = "/bodies/second={'material':'steel','geometry':{'type':'box','lower':";
  const std::string fine =
      "/materials/fine={'type':'hypoelastic','density':8000,'bulk_modulus':1e10,'shear_modulus':7e9,"
      "'particles_per_axis':4} /bodies/block/material=fine /particles_per_cell=[1,1] ";

  check(problems_with,
        {{"/bodies={}", "/bodies: an empty object; expected at least one entry"},
         {"/bodies/a.b={'material':'steel'}",
          "*#/bodies/a.b: a name with other characters; expected letters, digits, - and _ only*"},
         {"/bodies/block/material=stel", "/bodies/block/material: \"stel\"; expected steel, did you mean \"steel\"?"},
         {"/bodies/block/geometry/upper=[1,2.5]",
          geometry +
              "reaches beyond y+, the plane y = 2 m, and is not symmetric about it: the image of its place "
              "[0.5, 0] is not in it" +
              within_or_cut},
         {"/bodies/block/geometry/upper=[1,2.5] /boundaries/y+=open",
          geometry + "reaches from [0, 0] to [1, 2.5]" + within_or_cut},
         {"/bodies/block/geometry/upper=[1,4]", ""},
         {"/bodies/block/geometry/upper=[1,4] /boundaries/y+={'friction':0.1}",
          geometry + "reaches from [0, 0] to [1, 4]" + within_or_cut},
         {"/bodies/block/geometry/upper=[-1,1]", geometry + "box from*lower < upper*"},
         {"/bodies/block/geometry/upper=[0.1,0.1]",
          geometry + "holds no particle; expected a shape that holds a site of the particle lattice, whose spacing is "
                     "0.5 m"},
         {second + "[0.5,0.5],'upper':[2,2]}}", overlap + "[0.75, 0.75]; expected bodies that share no particle"},
         // The second body's only particle is at (1.5, 1.5).
         {fine + second + "[0.8,0.8],'upper':[2,2]}}",
          overlap + "[0.875, 0.875]; expected bodies that share no particle"}});
}

TEST_CASE("more bodies than a step has room for are refused")
{
  std::string bodies;
  for (int i = 0; i < 17; ++i) {
    bodies += "/bodies/b" + std::to_string(i) +
              "={'material':'steel','geometry':{'type':'box','lower':[0,1],'upper':[1,2]}} ";
  }
  check(problems_with, {{bodies, "scene.json#/bodies: 18 entries; expected at most 16"}});
}

TEST_CASE("a projectile that starts inside the sand is refused with where")
{
  const std::string translation = "/bodies/projectile/geometry/translation=";

  check(shipped("uxo/quick.json"), "/bodies/projectile/nose=null /bodies/projectile/tail=null",
        {{translation + "[0.045,0.05,0.1085]", ""},
         {translation + "[0.045,0.05,0.106]",
          "*#/bodies/sand: overlaps body \"projectile\", at [0.04*; expected bodies that share no particle*"}});
}

TEST_CASE("rings of particles in what is no disk, or where a problem lays them out, are refused")
{
  const std::string rings = "/bodies/block/particles=rings";

  check(problems_with,
        {{rings, "/bodies/block/particles: rings, of a body that is no disk; expected a \"ball\" in two dimensions"},
         {rings + " /bodies/block/geometry={'type':'ball','centre':[1,1],'radius':0.7} "
                  "/bodies/block/problem={'type':'rotating_disk','centre':[1,1],'outer_radius':0.7,'angular_speed':1}",
          "/bodies/block/particles: rings, of a body with a problem; expected those of the problem alone"}});
}

TEST_CASE("sand that cannot have settled is refused with why")
{
  const std::string stress = "/bodies/block/initial_stress", settled = stress + "=true ";
  const std::string floor = settled + "/bodies/block/geometry/upper=[2,1] /gravity=[0,-10] ";
  const std::string moves = stress + ": a body with a velocity; expected one at rest";

  check(problems_with, {{settled, stress + ": material \"steel\"; expected a material of type tabular_cap"}});
  check(problems_with_sand, "/bodies/block/material=sand",
        {{settled, stress + ": a body not between walls along xy; expected sides and floor on walls, and one free "
                            "face"},
         {settled + "/bodies/block/geometry/upper=[2,1] /gravity=[0,1e7]",
          stress + ": q = *at most the sand's strength there*"},
         {settled + "/bodies/block/geometry={'type':'difference','of':[{'type':'box','lower':[0,0],'upper':[2,1.5]},"
                    "{'type':'box','lower':[0,0.5],'upper':[2,1]}]} /gravity=[0,-10]",
          stress + ": a region with a gap along y; expected a box"},
         {floor + "/bodies/block/velocity=[0,0]", ""},
         {floor + "/bodies/block/velocity=[0,1]", moves},
         {floor + "/bodies/block/angular_velocity=[1]", moves},
         {floor + "/bodies/block/rigid=true",
          stress + ": a rigid body, which has no stress; expected one that is not rigid"}});
}

TEST_CASE("a nose or a tail that is not of its body, or the same place, is refused")
{
  const std::string nose = "/bodies/block/nose", tail = "/bodies/block/tail";
  const std::string within = "; expected a place within the body or on its surface";

  check(problems_with,
        {{nose + "=[0.5,0] /bodies/block/tail=[0.5,1]", ""},
         {nose + "=[0,0] /bodies/block/tail=[1,1]", ""},
         {nose + "=[0.5,-0.6] /bodies/block/tail=[0.5,1]", nose + ": [0.5, -0.6]" + within},
         {nose + "=[0.5,0] /bodies/block/tail=[1.6,1]", tail + ": [1.6, 1]" + within},
         {nose + "=[1] /bodies/block/tail=[0,0]", nose + ": [1]; expected 2 numbers"},
         {nose + "=[0,0]", "scene.json#/bodies/block/tail: missing; expected 2 numbers"},
         {nose + "=[1,1] /bodies/block/tail=[1,1]", tail + ": [1, 1]; expected another place than the nose's"}});
}

TEST_CASE("rigid bodies whose contact nothing could tell are refused")
{
  const std::string body = "={'material':'steel','rigid':true,'geometry':{'type':'box',";
  const std::string other = "/bodies/other" + body;
  const std::string iron =
      " /materials/iron={'type':'hypoelastic','density':8000,'bulk_modulus':10e9,'shear_modulus':7e9} "
      "/bodies/other/material=iron";

  check(problems_with,
        {{"/bodies/block/rigid=1", "/bodies/block/rigid: 1; expected true or false"},
         {"/bodies/block/angular_velocity=[1,2,3]", "/bodies/block/angular_velocity: [1,2,3]; expected 1 numbers"}});
  check(
      problems_with, "/grid/upper=[9,9] /bodies/block" + body + "'lower':[2,2],'upper':[3,3]}}",
      {{"", ""},
       {"/particles_per_cell=[1,1]",
        "/bodies/block/rigid: a rigid body of one particle; expected two or more, so that it has an orientation"},
       {other + "'lower':[6,6],'upper':[7,7]}}",
        "*#/bodies/block: rigid, but of one material with body \"other\"; expected a material of its own*"},
       {"/bodies/block/geometry/lower=[0,2]", ""},
       {"/bodies/block/geometry/lower=[0,2] /boundaries/x-=open",
        "*#/bodies/block: rigid, and less than a cell from the edge of the grid; expected all nodes that it reaches to "
        "lie within the grid, but for \"symmetry\" faces on which it lies or along which it is driven without turning"},
       {other + "'lower':[3,2],'upper':[4,3]}}" + iron,
        "*so near to the rigid body \"block\" that they meet; expected one of them to be deformable*"},
       {other + "'lower':[4,2],'upper':[5,3]}}" + iron, ""}});
}

TEST_CASE("a driven body is rigid, is driven in one way, and starts as it is driven")
{
  const std::string driven = "/bodies/block/driven", how = driven + "=";
  const std::string ways = " of the keys for it; expected one of velocity, velocities and displacements";
  const std::string alone = ": a driven body's; expected the motion under the key driven alone";

  check(problems_with,
        "/grid/upper=[9,9] /bodies/block/rigid=true /bodies/block/geometry/lower=[2,2] "
        "/bodies/block/geometry/upper=[3,3]",
        {{how + "{'velocity':[0,-1]}", ""},
         {how + "{'velocities':[[0,0,0],[1,0,-1]],'rotation':'free'} /bodies/block/angular_velocity=[1]", ""},
         {how + "{'displacements':[[0,0,0],[1,0,-1]]}", ""},
         {how + "{'velocity':[0,-1]} /bodies/block/rigid=false",
          driven + ": a body that is not rigid; expected a rigid one"},
         {how + "{}", driven + "/velocity: 0" + ways},
         {how + "{'velocity':[0,-1],'displacements':[[0,0,0],[1,0,-1]]}", driven + "/velocity: 2" + ways},
         {how + "{'velocity':[0]}", driven + "/velocity: [0]; expected 2 numbers"},
         {how + "{'velocities':[[0,-1]]}", "*expected a list of lists of 3 numbers*"},
         {how + "{'velocities':[[1,0,0],[1,0,-1]]}",
          driven + "/velocities: 1.000000 s after 1.000000 s; expected times that ascend"},
         {how + "{'displacements':[[0,0,1],[1,0,-1]]}",
          driven + "/displacements: a first displacement that is not 0; expected the body to start where it is"},
         {how + "{'velocity':[0,-1],'rotation':'loose'}", driven + "/rotation: \"loose\"; expected one of held, free"},
         {how + "{'velocity':[0,-1]} /bodies/block/velocity=[0,-1]", "/bodies/block/velocity" + alone},
         {how + "{'velocity':[0,-1]} /bodies/block/angular_velocity=[1]", "/bodies/block/angular_velocity" + alone}});
}

TEST_CASE("a driven body may lie against a mirror along which it goes without turning, and against no other face")
{
  const std::string how = "/bodies/block/driven=";
  const std::string is_near = "*#/bodies/block: rigid, and less than a cell from the edge*";

  check(problems_with,
        "/grid/upper=[9,9] /bodies/block/rigid=true /bodies/block/geometry/lower=[0,2] "
        "/bodies/block/geometry/upper=[1,3] /boundaries/x-=symmetry",
        {{how + "{'velocity':[0,-1]}", ""},
         {how + "{'velocity':[1,-1]}", is_near},
         {how + "{'velocity':[0,-1],'rotation':'free'}", ""},
         {how + "{'velocity':[1,-1],'rotation':'free'}", "*#/bodies/block/driven: a motion across the plane*"},
         {how + "{'velocity':[0,-1]} /boundaries/x-=open", is_near}});
}

TEST_CASE("half of a scene that is not symmetric is refused where it is not")
{
  const std::string on_plane =
      " the plane of symmetry x-, on which the body lies; expected what the mirror image in "
      "that plane has, too";
  const std::string at_plane = " the plane of symmetry x-, on which body \"block\" lies; expected gravity along it";
  const std::string block = "/bodies/block/";

  check(problems_with, "/grid/upper=[9,9] /bodies/block/geometry/lower=[-1,2] /bodies/block/geometry/upper=[1,3]",
        {{"", ""},
         {"/bodies/block/rigid=true", ""},
         {"/bodies/block/velocity=[0,-1]", ""},
         {"/bodies/block/velocity=[1,-1]", block + "velocity: a velocity across" + on_plane},
         {"/bodies/block/angular_velocity=[2]", block + "angular_velocity: a spin that turns it out of" + on_plane},
         {"/bodies/block/nose=[0,2] /bodies/block/tail=[0,3]", ""},
         {"/bodies/block/nose=[0.5,2] /bodies/block/tail=[0,3]", block + "nose: a place beside" + on_plane},
         {"/bodies/block/pressure={'value':1}", ""},
         {"/bodies/block/pressure={'value':1,'within':{'lower':[-5,2.9],'upper':[5,3]}}", ""},
         {"/bodies/block/pressure={'value':1,'within':{'lower':[0,2.9],'upper':[0.5,3]}}", ""},
         {"/bodies/block/pressure={'value':1,'within':{'lower':[-0.5,2.9],'upper':[0.5,3]}}", ""},
         {"/bodies/block/pressure={'value':1,'within':{'lower':[-0.5,2.9],'upper':[5,3]}}",
          block + "pressure/within: a box that is not symmetric about" + on_plane},
         {"/gravity=[1,0]", "/gravity: a part across" + at_plane},
         {"/bodies/block/geometry/upper=[1.5,3]",
          "scene.json#" + block +
              "geometry: reaches beyond x-*is not symmetric about it*cut in halves by a \"symmetry\" face"}});
  check(problems_with,
        "/grid/upper=[9,9] /bodies/block/rigid=true /bodies/block/geometry/lower=[0,2] "
        "/bodies/block/geometry/upper=[1,3]",
        {{"", ""},
         {"/bodies/block/velocity=[-1,0]", block + "velocity: a velocity across" + on_plane},
         {"/boundaries/x-=open", "*#/bodies/block: rigid, and less than a cell from the edge*"}});
}

TEST_CASE("fields to be written are named once each, and of the scene's materials")
{
  const std::string expected =
      "; expected a list of some of position, velocity, stress, p, q, density, J, uneven_pressure, torn_apart, "
      "nodes/density, nodes/velocity";

  check(problems_with, {{"/output/fields=['p','nodes/density','J']", ""},
                        {"/output/fields=[]", ""},
                        {"/output/fields='p'", "/output/fields: \"p\"" + expected},
                        {"/output/fields=[1]", "/output/fields: [1]" + expected},
                        {"/output/fields=['p','p']", "/output/fields: \"p\" twice" + expected},
                        {"/output/fields=['velocty']", "/output/fields: \"velocty\"" + expected + "*velocity\"?*"},
                        {"/output/fields=['equivalent_plastic']", "*\"equivalent_plastic\"*"}});
}

TEST_CASE("what cannot be turned about the axis of an axisymmetric scene is refused")
{
  const std::string block = "/bodies/block/";
  const std::string rigid =
      "/grid/upper=[9,9] /bodies/block/rigid=true /bodies/block/geometry/lower=[2,2] "
      "/bodies/block/geometry/upper=[3,3] ";

  check(
      problems_with, "/axisymmetric=true",
      {{"", ""},
       {"/grid/lower=[-1,0]", "*#/grid/lower: r = -1 m, in an axisymmetric scene; expected x from 0 on, *"},
       {"/grid/lower=[0,-1]", ""},
       {"/boundaries={'x-':'open'}",
        "*#/boundaries/x-: another face than \"symmetry\" on the axis of an axisymmetric scene; expected *"},
       {"/boundaries={'x-':'periodic','x+':'periodic'}", "*#/boundaries/x-: periodic in r, in an axisymmetric *"},
       {"/gravity=[1,0]", "/gravity: 1 m/s^2 across the axis of an axisymmetric scene; expected gravity along y alone"},
       {"/gravity=[0,-1]", ""},
       {"/anti_locking=f_bar", ""},
       {block + "velocity=[1,0]",
        block + "velocity: a motion across the axis of an axisymmetric scene; expected one along y alone"},
       {block + "velocity=[0,1]", ""},
       {block + "angular_velocity=[1]",
        block + "angular_velocity: a rotation across the axis of an axisymmetric scene; expected none"},
       {block + "nose=[1,0] /bodies/block/tail=[0,1]",
        block + "nose: a place at r = 1 m; expected one on the axis of the scene, with x = 0"},
       {rigid + block + "driven={'velocity':[1,0]}",
        block + "driven: a motion across the axis of an axisymmetric scene; expected one along y alone"},
       {rigid + block + "driven={'velocity':[0,1]}", ""},
       {block + "geometry={'type':'ball','centre':[0,1],'radius':0.5} /bodies/block/particles=rings", "*"}});
  check(problems_with, {{"/axisymmetric=1", "/axisymmetric: 1; expected true or false"}});
  check(shipped("cone/quick.json"), "",
        {{"/axisymmetric=true",
          "/axisymmetric: a scene of dimension 3; expected one of dimension 2, the plane of r and z"}});
}

}  // namespace test_bad_scenes
