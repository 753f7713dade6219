#include "tests/tools/scene/bad_scenes.hpp"

namespace test_bad_scenes
{

using namespace tamp::test;

TEST_CASE("keys that are missing or unknown are refused, and values of a wrong type or out of range")
{
  const std::string pointer = ": not an assignment; expected /POINTER=VALUE, such as /grid/cell_size=0.01";

  check_rows(
      problems_with,
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
  const std::string whole = "; expected a whole number of them, as with 2.1 m in /grid/upper";

  check_rows(
      problems_with,
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
  check_rows(problems_with, {{"/time/multiplier=101", "/time/multiplier: 101; expected a number above 0 and up to 100"},
                             {"/time/multiplier=100", ""},
                             {"/time/multiplier=0", "/time/multiplier: 0; expected a number above 0 and up to 100"},
                             {"/time/maximum_step=1e-13",
                              "/time/maximum_step: 1e-13; expected no less than the minimum step, 1e-12"}});
}

TEST_CASE("a method that is none of the choices, or does not go with another choice, is refused")
{
  const std::string energy = "; expected another transfer, as particles would gain energy where the wall stops nodes";

  check_rows(
      problems_with,
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
       {"/transfer=fmpm /boundaries/y-/friction=0.3",
        "/transfer: fmpm of order 2 with a wall that can be left" + energy},
       {"/transfer=fmpm /filter_order=1 /boundaries/y-/friction=0.3", ""}});
}

TEST_CASE("FMPM where contact would give particles energy is refused")
{
  const std::string not_met = "/transfer: fmpm of order 2 with materials that do not meet*";

  check_rows(problems_with,
             "/materials/soil={'type':'hypoelastic','density':1,'bulk_modulus':1,'shear_modulus':1} "
             "/bodies/other={'material':'soil','geometry':{'type':'box','lower':[0,1],'upper':[1,2]}} /transfer=fmpm",
             {{"", ""},
              {"/contact=[{'materials':['steel','soil'],'friction':0}]", ""},
              {"/contact=[{'materials':['steel','soil'],'friction':0,'normal':'flatter'}]", not_met},
              {"/contact=[{'materials':['steel','soil'],'friction':0,'normal':'steel'}]", not_met}});
}

TEST_CASE("sand that has to forget its gradients is not updated before it has them")
{
  check_rows(
      shipped("punch/quick.json"),
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
  const std::string words =
      "; expected one of symmetry, open, no_slip, periodic, {\"friction\": MU, \"at_edges\": true}";
  const std::string pair =
      ": a face that is not periodic, opposite to one that is; expected both faces of an axis periodic, or neither";

  check_rows(problems_with,
             {{"/boundaries/y-=no_slip", ""},
              {"/boundaries/y-={'friction':0.4}", ""},
              {"/boundaries/y-={'friction':0.4,'at_edges':true}", ""},
              {"/boundaries/y-={'friction':0.4,'at_edges':1}", "/boundaries/y-/at_edges: 1; expected true or false"},
              {"/boundaries/y-={'at_edges':true}", "*#/boundaries/y-/friction: missing*"},
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
  check_rows(
      problems_with,
      "/grid/upper=[9,9] /bodies/block/geometry/lower=[2,2] /bodies/block/geometry/upper=[5,5] "
      "/boundaries={'y-':'periodic','y+':'periodic'}",
      {{"/bodies/block/velocity=[0,1]", ""},
       {"/bodies/block/rigid=true",
        "/bodies/block/rigid: a rigid body, which cannot go around, between periodic boundaries; expected one that "
        "is not rigid, or other boundaries"},
       {"/bodies/block/nose=[3,2] /bodies/block/tail=[3,5]",
        "/bodies/block/nose: a nose, whose surroundings cannot go around, between periodic boundaries; expected "
        "none, or other boundaries"}});
  check_rows(problems_with_sand,
             {{"/grid/upper=[3,2] /boundaries={'x-':'periodic','x+':'periodic'} "
               "/contact=[{'materials':['steel','sand'],'friction':0,'normal':'regression'}]",
               "/contact/0/normal: regression, whose planes have one place each, between periodic boundaries; expected "
               "another normal"}});
}

TEST_CASE("a centrifuge whose numbers make no rotation, or that turns what cannot turn, is refused")
{
  const std::string turning = "/centrifuge={'angular_speed':1,'axis':[1,0,0],'centre':[0,0,0]}";

  check_rows(problems_with,
             {{"/centrifuge={'angular_speed':6}", "/centrifuge: a plane scene; expected one of dimension 3"}});
  check_rows(
      problems_with,
      "/dimension=3 /grid/upper=[3,2,2] /bodies/block/geometry={'type':'box','lower':[0,0,0],'upper':[1,1,1]}",
      {{"/centrifuge={'angular_speed':6,'axis':[1,0,0],'centre':[0,0,5]}", ""},
       {"/centrifuge={'angular_speed':6,'axis':[0,0,0],'centre':[0,0,5]}",
        "/centrifuge/axis: an axis of zero length; expected a direction"},
       {"/centrifuge={'angular_speed':-6,'axis':[1,0,0],'centre':[0,0,5]}",
        "/centrifuge/angular_speed: -6; expected a number of 0 or above [rad/s]"},
       {"/centrifuge={'angular_speed':6,'axis':['NaN',0,0],'centre':[0,0,5]}", "/centrifuge/axis*"},
       {"/boundaries={'x-':{'friction':0.4},'z-':{'friction':0.4}}", ""},
       {"/boundaries={'x-':{'friction':0.4},'z-':{'friction':0.4}} " + turning,
        "/centrifuge: a wall that can be left; expected other boundaries where the grid turns"},
       {"/boundaries={'x-':{'friction':0.4,'at_edges':true}} " + turning, "/centrifuge: a wall that can be left*"},
       {"/boundaries={'x-':'periodic','x+':'periodic'} " + turning,
        "/centrifuge: periodic boundaries, whose ends are not alike in a turning grid; expected other boundaries "
        "where the grid turns"}});
}

TEST_CASE("local damping is a part of a force")
{
  check_rows(problems_with, {{"/local_damping=0.3", ""},
                             {"/local_damping=1", "/local_damping: 1; expected a number*"},
                             {"/local_damping=-0.1", "/local_damping: -0.1; expected a number*"}});
}

TEST_CASE("fields to be written are named once each, and of the scene's materials")
{
  const std::string expected =
      "; expected a list of some of position, velocity, stress, p, q, density, J, uneven_pressure, torn_apart, "
      "nodes/density, nodes/velocity";

  check_rows(problems_with, {{"/output/fields=['p','nodes/density','J']", ""},
                             {"/output/fields=[]", ""},
                             {"/output/fields='p'", "/output/fields: \"p\"" + expected},
                             {"/output/fields=[1]", "/output/fields: [1]" + expected},
                             {"/output/fields=['p','p']", "/output/fields: \"p\" twice" + expected},
                             {"/output/fields=['velocty']", "/output/fields: \"velocty\"" + expected + "*velocity\"?*"},
                             {"/output/fields=['equivalent_plastic']", "*\"equivalent_plastic\"*"}});
}

}  // namespace test_bad_scenes
