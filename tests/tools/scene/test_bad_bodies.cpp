#include "tests/tools/scene/bad_scenes.hpp"

namespace test_bad_bodies
{

using namespace tamp::test;

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

  check_rows(
      problems_with,
      {{"/bodies={}", "/bodies: an empty object; expected at least one entry"},
       {"/bodies/a.b={'material':'steel'}",
        "*#/bodies/a.b: a name with other characters; expected letters, digits, - and _ only*"},
       {"/bodies/block/material=stel", "/bodies/block/material: \"stel\"; expected steel, did you mean \"steel\"?"},
       {"/bodies/block/geometry/upper=[1,2.5]",
        geometry +
            "reaches beyond y+, the plane y = 2 m, and is not symmetric about it: the image of its place "
            "[0.25, 0.25] is not in it" +
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

TEST_CASE("lengths that are too large to multiply, and a body beyond a mirror, are refused at their place")
{
  const std::string geometry = "/bodies/block/geometry", moved = geometry + "={'type':'transform','translation':";
  const std::string ball = "'of':{'type':'ball','centre':[1,1],'radius':0.5}}";

  check_rows(problems_with,
             {{geometry + "={'type':'ball','centre':[1,1],'radius':1e308}",
               geometry + "/radius: 1e+308; expected a number of at most 1e+50"},
              {geometry + "={'type':'polygon','corners':[[0,0],[1,0],[-1e300,1]]}",
               geometry + "/corners: [[0,0],[1,0],[-1e+300,1]]; expected numbers of at most 1e+50"},
              {moved + "[0,1e308]," + ball, geometry + "/translation: [0,1e+308]; expected numbers of at most 1e+50"},
              {moved + "[0,1e49]," + ball,
               geometry + ": reaches from [0.5, 1e+49] to [1.5, 1e+49]; expected it to lie within *"}});
}

TEST_CASE("more bodies than a step has room for are refused")
{
  std::string bodies;
  for (int i = 0; i < 17; ++i) {
    bodies += "/bodies/b" + std::to_string(i) +
              "={'material':'steel','geometry':{'type':'box','lower':[0,1],'upper':[1,2]}} ";
  }
  check_rows(problems_with, {{bodies, "scene.json#/bodies: 18 entries; expected at most 16"}});
}

TEST_CASE("a projectile that starts inside the sand is refused with where")
{
  const std::string translation = "/bodies/projectile/geometry/translation=";

  check_rows(shipped("uxo/quick.json"), "/bodies/projectile/nose=null /bodies/projectile/tail=null",
             {{translation + "[0.045,0.05,0.1085]", ""},
              {translation + "[0.045,0.05,0.106]",
               "*#/bodies/sand: overlaps body \"projectile\", at [0.04*; expected bodies that share no particle*"}});
}

TEST_CASE("what meets a rigid body by its solid is deformable, and the body not thinner than its particles")
{
  const std::string normal = "*#/contact/0/normal: solid, ";

  check_rows(shipped("savings/ball.json"),
             {{"", ""},
              {"/bodies/ball/rigid=false", normal + "and no rigid body; expected one of the two materials to be a *"},
              {"/bodies/sand/rigid=true", normal + "between two rigid bodies; expected one of the two *"},
              {"/bodies/ball/geometry={'type':'box','lower':[0,0.0602],'upper':[0.012,0.0606]}",
               normal + "of body \"ball\", which is about 0.0002 m thick; expected a body at least half as thick as "
                        "the particles that touch it, 0.001 m, *"}});
}

TEST_CASE("rings of particles in what is no disk, or where a problem lays them out, are refused")
{
  const std::string rings = "/bodies/block/particles=rings";

  check_rows(
      problems_with,
      {{rings, "/bodies/block/particles: rings, of a body that is no disk; expected a \"ball\" in two dimensions"},
       {rings + " /bodies/block/geometry={'type':'ball','centre':[1,1],'radius':0.7} "
                "/bodies/block/problem={'type':'rotating_disk','centre':[1,1],'outer_radius':0.7,'angular_speed':1}",
        "/bodies/block/particles: rings, of a body with a problem; expected those of the problem alone"}});
}

TEST_CASE("particles cannot be cut where a problem lays them out, or where layers are to be whole")
{
  const std::string cut = "/bodies/block/particles=cut ";

  check_rows(
      problems_with,
      {{cut + "/bodies/block/initial_stress=true",
        "/bodies/block/particles: cut, of a body with \"initial_stress\"; expected whole layers: the lattice's"},
       {cut + "/bodies/block/geometry={'type':'ball','centre':[1,1],'radius':0.7} "
              "/bodies/block/problem={'type':'rotating_disk','centre':[1,1],'outer_radius':0.7,'angular_speed':1}",
        "/bodies/block/particles: cut, of a body with a problem; expected those of the problem alone"}});
}

TEST_CASE("sand that cannot have settled is refused with why")
{
  const std::string stress = "/bodies/block/initial_stress", settled = stress + "=true ";
  const std::string floor = settled + "/bodies/block/geometry/upper=[2,1] /gravity=[0,-10] ";
  const std::string moves = stress + ": a body with a velocity; expected one at rest";

  const std::string rubber =
      "/materials/rubber={'type':'neo_hookean','density':1000,'bulk_modulus':1e6,'shear_modulus':1e6} "
      "/bodies/block/material=rubber";
  check_rows(problems_with,
             {{settled + rubber, stress + ": material \"rubber\" of type neo_hookean; expected one of "
                                          "type hypoelastic, drucker_prager, mohr_coulomb, bolton_sand, tabular_cap"}});
  check_rows(
      problems_with_sand, "/bodies/block/material=sand",
      {{settled, stress + ": a body not between walls along xy; expected sides and floor on walls, and one free "
                          "face"},
       {settled + "/bodies/block/geometry/upper=[2,1] /gravity=[0,1e7]", stress + ": q = *at most the strength there*"},
       {settled + "/bodies/block/geometry={'type':'difference','of':[{'type':'box','lower':[0,0],'upper':[2,1.5]},"
                  "{'type':'box','lower':[0,0.5],'upper':[2,1]}]} /gravity=[0,-10]",
        stress + ": a region with a gap along y; expected a box along the axes; other ground can settle in the run, "
                 "with \"local_damping\""},
       {settled + "/bodies/block/geometry={'type':'polygon','corners':[[0,0],[2,0],[2,2],[1,2]]}",
        stress + ": a region with 12 of the 16 particles of the box around it; expected a box along the axes*"},
       {floor + "/bodies/block/velocity=[0,0]", ""},
       {floor + "/bodies/block/velocity=[0,1]", moves},
       {floor + "/bodies/block/angular_velocity=[1]", moves},
       {floor + "/bodies/block/rigid=true",
        stress + ": a rigid body, which has no stress; expected one that is not rigid"}});
}

TEST_CASE("ground whose sides press too little or not at all is refused with where")
{
  const std::string k0 = "/bodies/block/k0", settled = "/bodies/block/initial_stress=true /gravity=[0,-10] ";
  const std::string soil =
      "/materials/soil={'type':'drucker_prager','density':2000,'bulk_modulus':2e8,'shear_modulus':1e8,"
      "'friction_angle':30} /bodies/block/material=soil /bodies/block/geometry/upper=[2,1] /boundaries/y+=open ";

  check_rows(problems_with, soil + settled,
             {{k0 + "=0.34", ""},
              // (1 - sin 30) / (1 + sin 30)
              {k0 + "=0.33", "/bodies/block/initial_stress: q = *at most the strength there*"},
              {k0 + "=7.1", "/bodies/block/initial_stress: q = *at most the strength there*"},
              {k0 + "=0", k0 + ": 0*"},
              {k0 + "=0.5 /bodies/block/initial_stress=false",
               k0 + ": that of a body without \"initial_stress\"; expected it with that key"}});
}

TEST_CASE("strata with a gap between them, or of unlike particles, are refused with which")
{
  const std::string second =
      "/bodies/second={'material':'fine','initial_stress':true,'geometry':{'type':'box','lower':";
  const std::string pile =
      "/grid/upper=[2,4] /boundaries/y+=open /gravity=[0,-10] /bodies/block/geometry/upper=[2,1] "
      "/bodies/block/initial_stress=true /materials/fine={'type':'hypoelastic','density':2000,'bulk_modulus':1e9,"
      "'shear_modulus':7e8} ";

  check_rows(
      problems_with, pile,
      {{second + "[0,1],'upper':[2,2]}}", ""},
       {second + "[0,1.5],'upper':[2,2]}}",
        "*a gap of 0.5 m between bodies \"block\" and \"second\"; expected bodies "
        "that lie on one another*"},
       {second + "[0,1],'upper':[2,2]}} /materials/fine/particles_per_axis=3",
        "*2 particles along the edge of a cell in body \"block\", 3 in body \"second\"; expected the same number*"},
       {second + "[0,1],'upper':[2,4]}} /boundaries/y+=symmetry", "*: two walls along y; expected sides and floor*"}});
}

TEST_CASE("a nose or a tail that is not of its body, or the same place, is refused")
{
  const std::string nose = "/bodies/block/nose", tail = "/bodies/block/tail";
  const std::string within = "; expected a place within the body or on its surface";

  check_rows(problems_with,
             {{nose + "=[0.5,0] /bodies/block/tail=[0.5,1]", ""},
              {nose + "=[0,0] /bodies/block/tail=[1,1]", ""},
              {nose + "=[0.5,-0.6] /bodies/block/tail=[0.5,1]", nose + ": [0.5, -0.6]" + within},
              {nose + "=[0.5,0] /bodies/block/tail=[1.6,1]", tail + ": [1.6, 1]" + within},
              {nose + "=[1] /bodies/block/tail=[0,0]", nose + ": [1]; expected 2 numbers"},
              {nose + "=[0,0]", "scene.json#/bodies/block/tail: missing; expected 2 numbers"},
              {nose + "=[1,1] /bodies/block/tail=[1,1]", tail + ": [1, 1]; expected another place than the nose's"}});
}

TEST_CASE("a pressure load pushes on a surface of a body that is not rigid")
{
  // The block of 1 m x 1 m lies against walls on its left and below it.
  const std::string pressure = "/bodies/block/pressure", load = pressure + "=";
  const std::string surface = "; expected a box that holds some of the body's surface";

  check_rows(
      problems_with,
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

TEST_CASE("rigid bodies whose contact nothing could tell are refused")
{
  const std::string body = "={'material':'steel','rigid':true,'geometry':{'type':'box',";
  const std::string other = "/bodies/other" + body;
  const std::string iron =
      " /materials/iron={'type':'hypoelastic','density':8000,'bulk_modulus':10e9,'shear_modulus':7e9} "
      "/bodies/other/material=iron";

  check_rows(problems_with, {{"/bodies/block/rigid=1", "/bodies/block/rigid: 1; expected true or false"},
                             {"/bodies/block/angular_velocity=[1,2,3]",
                              "/bodies/block/angular_velocity: [1,2,3]; expected 1 numbers"}});
  check_rows(
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

  check_rows(
      problems_with,
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

  check_rows(problems_with,
             "/grid/upper=[9,9] /bodies/block/rigid=true /bodies/block/geometry/lower=[0,2] "
             "/bodies/block/geometry/upper=[1,3] /boundaries/x-=symmetry",
             {{how + "{'velocity':[0,-1]}", ""},
              {how + "{'velocity':[1,-1]}", is_near},
              {how + "{'velocity':[0,-1],'rotation':'free'}", ""},
              {how + "{'velocity':[1,-1],'rotation':'free'}", "*#/bodies/block/driven: a motion across the plane*"},
              {how + "{'velocity':[0,-1]} /boundaries/x-=open", is_near}});
}

}  // namespace test_bad_bodies
