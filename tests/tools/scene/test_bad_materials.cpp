#include "tests/tools/scene/bad_scenes.hpp"

namespace test_bad_materials
{

using namespace tamp::test;

TEST_CASE("a material of no type, or whose numbers do not go together, is refused")
{
  check_rows(problems_with,
             {{"/materials/steel/type=hypoelastik",
               "/materials/steel/type: \"hypoelastik\"; expected one of hypoelastic, neo_hookean, neo_hookean_log, "
               "drucker_prager, mohr_coulomb, bolton_sand, tabular_cap, did you mean \"hypoelastic\"?"},
              {"/materials/steel/density=-8000", "/materials/steel/density: -8000; expected a number above 0 [kg/m^3]"},
              {"/materials/steel/particles_per_axis=2.5",
               "/materials/steel/particles_per_axis: 2.5; expected a whole number from 1 to 16"},
              {"/materials/steel/particles_per_axis=0",
               "/materials/steel/particles_per_axis: 0; expected a whole number from 1 to 16"}});
  for (const std::string type : {"hypoelastic", "neo_hookean", "neo_hookean_log"}) {
    check_rows(
        problems_with, "/materials/steel/type=" + type,
        {{"/materials/steel/bulk_modulus=0", "/materials/steel/bulk_modulus: 0; expected a number above 0 [Pa]"},
         {"/materials/steel/shear_modulus=-1", "/materials/steel/shear_modulus: -1; expected a number above 0 [Pa]"}});
  }
}

TEST_CASE("a type over that of the file named beside it is one problem, with what to set instead")
{
  const std::string sand = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand/table.json";

  check_rows(problems_with,
             {{"/materials/steel/file=" + sand,
               "scene.json#/materials/steel/type: \"hypoelastic\" over the \"tabular_cap\" of " + sand +
                   ", whose keys it has not; expected the type of the file; --set '/materials/steel={\"file\":\"" +
                   sand + "\"}' takes all of it"},
              {"/materials/steel={'file':'" + sand + "'}", ""}});
}

TEST_CASE("a type over that of a file whose keys it has is taken")
{
  const TemporaryFolder folder;
  const auto file = folder.write("steel.json", R"({"type": "neo_hookean", "density": 1, "bulk_modulus": 1})");

  CHECK(problems_with({"/materials/steel/file=" + file.string()}).empty());
}

TEST_CASE("soil whose numbers do not go together is refused, with the one that does not")
{
  const std::string soil = "/materials/steel", friction = soil + "/friction_angle=30 ";

  check_rows(
      problems_with, soil + "={'type':'drucker_prager','density':1600,'bulk_modulus':1e7,'shear_modulus':1e7}",
      {{friction, ""},
       {"", "*#/materials/steel/friction_angle: missing; expected a number from 0 to below 90 [degrees]"},
       {friction + soil + "/dilation_angle=31",
        soil + "/dilation_angle: 31; expected at most the friction angle, 30: more would gain energy by flowing"},
       {friction + soil + "/cohesion=1e4 /materials/steel/tension_cutoff=2e4",
        soil + "/tension_cutoff: 20000; expected at most 17320.5 Pa, where the cone ends"},
       {friction + soil + "/cohesion=much", soil + "/cohesion: \"much\"; expected a number of 0 or above [Pa]"}});
}

TEST_CASE("sand by density and pressure whose packing or critical angle is that of no sand is refused")
{
  const std::string sand = "/materials/steel";

  check_rows(
      problems_with,
      sand +
          "={'type':'bolton_sand','density':1500,'grain_density':2650,'e_min':0.6,'e_max':1,"
          "'critical_friction_angle':32,'shear_modulus_number':125,'poisson_ratio':0.05} ",
      {{"", ""},
       {sand + "/density=1656.25", ""},
       {sand + "/density=1700",
        sand + "/density: 1700, a void ratio of 0.5588; expected 1325 to 1656.2 kg/m^3: from e_max 1 to e_min 0.6"},
       {sand + "/density=1200",
        sand + "/density: 1200, a void ratio of 1.208; expected 1325 to 1656.2 kg/m^3: from e_max 1 to e_min 0.6"},
       {sand + "/density=null " + sand + "/relative_density=0.5", ""},
       {sand + "/relative_density=0.5",
        sand + "/relative_density: 0.5 beside a density of 1500; expected one of the two, or 1472.22 kg/m^3"},
       {sand + "/density=null", sand + "/density: missing; expected a number above 0 [kg/m^3]"},
       {sand + "/density=null " + sand + "/relative_density=1.2",
        sand + "/relative_density: 1.2; expected a number from 0 to 1"},
       {sand + "/e_min=1", sand + "/e_min: 1; expected below e_max, 1"},
       {sand + "/critical_friction_angle=19",
        sand + "/critical_friction_angle: 19; expected a number from 20 to 45 [degrees]"},
       {sand + "/poisson_ratio=0.5", sand + "/poisson_ratio: 0.5; expected a number above -1 and below 0.5"}});
}

TEST_CASE("sand that separates at no density, or perhaps, is refused")
{
  check_rows(shipped("punch/quick.json"),
             {{"/materials/sand/separation=true", ""},
              {"/materials/sand/separation_density=1", ""},
              {"/materials/sand/separation=perhaps", "/materials/sand/separation: \"perhaps\"; expected true or false"},
              {"/materials/sand/separation_density=0",
               "/materials/sand/separation_density: 0; expected a number above 0 and up to 1"}});
}

TEST_CASE("contact of a material with itself, with an unknown one, or given twice is refused")
{
  check_rows(problems_with, {{"/contact=[{'materials':['steel','steel'],'friction':0}]",
                              "/contact/0/materials: \"steel\" twice; expected two different materials"},
                             {"/contact=[{'materials':['steel','snd'],'friction':0}]",
                              "/contact/0/materials: \"snd\"; expected 2 of steel"}});
  check_rows(problems_with_sand,
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

  check_rows(problems_with_sand,
             {{"", ""},
              {contact + "'sand'}]", ""},
              {contact + "'snd'}]",
               "/contact/0/normal: \"snd\"; expected one of flatter, regression, solid, steel, sand, did you mean "
               "\"sand\"?"},
              {contact + "1}]", "/contact/0/normal: 1; expected one of flatter, regression, solid, steel, sand"},
              {contact + "'solid'}]",
               "/contact/0/normal: solid, and no rigid body; expected one of the two materials to be a rigid body, or "
               "another normal"}});
  check_rows(
      problems_with,
      {{"/materials/flatter" + iron, "/materials/flatter" + word},
       {"/materials/regression" + iron, "/materials/regression" + word},
       {"/materials/flattest" + iron, ""},
       {"/materials/solid" + iron, ""},
       // Its own normal, as both are deformable.
       {"/materials/solid" + iron + " /contact=[{'materials':['steel','solid'],'friction':0,'normal':'solid'}]", ""}});
}

}  // namespace test_bad_materials
