#include "tools/study/study_keys.hpp"

#include "tools/study/study.hpp"

namespace tamp::tools::study
{

namespace
{

const ObjectKeys& measure_keys()
{
  static const ObjectKeys keys{
      "",
      {{"run", File{}, "", none, "a scene, which `tamp run` runs"},
       {"drive", File{}, "", none, "a material, which `tamp drive` takes along `path`"},
       {"path", File{}, "", none, "the path of deformation"},
       {"increment", Number{{.lower = 1e-9, .upper = 0.1}}, "", {1e-3}, "largest strain of an increment along it"},
       {"modulus", File{}, "", none, "a material, whose modulus `tamp modulus` gives at `states`"},
       {"states", File{}, "", none, "a table of elastic and plastic volumetric strains"}}};
  return keys;
}

const ObjectKeys& method_keys()
{
  static const ObjectKeys keys{
      "",
      {{"name", Text{}, "", compulsory, "what the charts call it"},
       {"family", Text{}, "", {}, "methods of one family share a colour; its name where left out"},
       {"dashed", Flag{}, "", {false}, "whether its line is dashed, as suits what others are measured by"},
       {"another_model", Flag{}, "", {false}, "models something else than the reference: it differs, and has no error"},
       {"set", Anything{}, "", {}, "an object: JSON pointer → value, over the study's"},
       {"sweep", Anything{}, "", {}, "its own, instead of the study's"}}};
  return keys;
}

const ObjectKeys& point_keys()
{
  static const ObjectKeys keys{"",
                               {{"method", Text{}, "", compulsory, "the name of a method"},
                                {"set", Anything{}, "", compulsory, "an object: JSON pointer → value"}}};
  return keys;
}

const ObjectKeys& quantity_keys()
{
  static const ObjectKeys keys{
      "",
      {{"name", Text{}, "", compulsory, "what the charts call it"},
       choice<Take>("take", Take::last,
                    {{"greatest", Take::greatest},
                     {"least", Take::least},
                     {"last", Take::last},
                     {"value", Take::value},
                     {"mean", Take::mean},
                     {"farthest", Take::farthest},
                     {"kept", Take::kept},
                     {"time_of_greatest", Take::time_of_greatest},
                     {"curve", Take::curve},
                     {"rows_rms", Take::rows_rms},
                     {"rows_max", Take::rows_max},
                     {"quantile", Take::quantile},
                     {"field_rms", Take::field_rms}},
                    "how it is taken"),
       {"column", Text{}, "", {}, "of `history.csv`, or of what `tamp drive` or `tamp modulus` writes"},
       {"plus", Anything{}, "", {}, "a list of columns that are added to it"},
       {"summary", Text{}, "", {}, "instead of a column: a JSON pointer to a number of `summary.json`"},
       {"at", Number{zero_or_above}, "s", none, "the time of a `value`, and that from which a `mean` is taken"},
       {"field", Text{}, "", {}, "of `quantile` and `field_rms`: a scalar field of the particles, such as `p`"},
       {"component", WholeNumber{0, 2}, "", none, "of a field of vectors: 0, 1 or 2 for x, y or z"},
       {"material", Text{}, "", {}, "whose particles"},
       {"line",
        Anything{},
        "",
        {},
        "of `field_rms`: what the field is to be at the origin, and its slopes along x, y, z"},
       {"quantile", Number{{.lower = 0, .upper = 1}}, "", {0.99}, "the part of the particles that lies below it"},
       {"exact", Number{}, "", none, "the exact answer"},
       {"scale", Number{above_zero}, "", none, "what errors are relative to, instead of the reference"}}};
  return keys;
}

const ObjectKeys& reference_keys()
{
  static const ObjectKeys keys{
      "",
      {{"set", Anything{}, "", {}, "an object: JSON pointer → value, over the study's"},
       {"refine", Text{}, "", {}, "a JSON pointer; without it the reference is one run, taken as it is"},
       {"values", Anything{}, "", {}, "of that pointer, from coarse to fine, three at least"},
       {"beside",
        Anything{},
        "",
        {},
        "a list of objects, JSON pointer → value, over these on the finest grid: forms with as good a claim, whose "
        "distance from the reference is the least that it is uncertain by"},
       {"of_each_method", Flag{}, "", {false}, "compares each method with runs of its own settings, under these"}}};
  return keys;
}

const ObjectKeys& base_keys()
{
  static const ObjectKeys keys{"",
                               {{"name", Text{}, "", compulsory, "of the settings whose error is asked for"},
                                {"set", Anything{}, "", {}, "an object: JSON pointer → value, over the study's"}}};
  return keys;
}

const ObjectKeys& part_keys()
{
  static const ObjectKeys keys{
      "",
      {{"name", Text{}, "", compulsory, "of the source of error"},
       {"to_reference", Flag{}, "", {false}, "its size is the distance from the reference"},
       {"set", Anything{}, "", {}, "a list of objects, JSON pointer → value: what differs most counts"}}};
  return keys;
}

const ObjectKeys& budget_keys()
{
  static const ObjectKeys keys{"",
                               {{"quantities", Anything{}, "", compulsory, "a list of their names"},
                                {"of", Objects{base_keys}, "", compulsory, "settings whose error is asked for"},
                                {"parts", Objects{part_keys}, "", compulsory, "sources of error"}}};
  return keys;
}

const ObjectKeys& expectation_keys()
{
  const char* of_fit = "of the fit through all values of the refined setting, three at least";
  const char* at_finest = "on the finest grid; without a refined setting, of every point";
  static const ObjectKeys keys{
      "",
      {{"quantity", Text{}, "", compulsory, "the name of a quantity"},
       {"methods", Anything{}, "", {}, "a list of their names; all where left out"},
       {"order_at_least", Number{}, "", none, of_fit},
       {"order_at_most", Number{}, "", none, of_fit},
       {"error_at_least", Number{zero_or_above}, "", none, at_finest},
       {"error_at_most", Number{zero_or_above}, "", none, at_finest},
       {"at", Number{}, "", none,
        "the value of the refined setting at which the error is judged; the finest if left out"},
       {"limit_error_at_most", Number{zero_or_above}, "", none,
        "of the limit a of a fit of answers by a + c h^p, h being the refined setting"},
       {"limit_order", Number{above_zero}, "", {1.0}, "p, with which errors fall by theory"},
       {"fails",
        Flag{},
        "",
        {false},
        "becomes unstable, or has an error that is half as large again on the finest grid as on some other"},
       {"why", Text{}, "", {}, "what says so, for people"},
       {"missed", Anything{}, "", {}, "an object: method that is known to miss it → why"}}};
  return keys;
}

const ObjectKeys& stability_keys()
{
  static const ObjectKeys keys{
      "",
      {{"quantity", Text{}, "", compulsory, "whose error is judged"},
       {"threshold", Number{above_zero}, "", compulsory, "an error that is clearly none of accuracy any more"},
       {"fails", Text{}, "", compulsory, "the method that becomes unstable, or has an error of 3 thresholds at least"},
       {"survives", Text{}, "", compulsory, "the method whose error is below a third of the threshold"},
       {"symptom", Text{}, "", compulsory, "what is seen, for people"},
       {"monitor", Text{}, "", compulsory,
        "the number of a run that tells: of `monitors` in `summary.json`, or another"}}};
  return keys;
}

const ObjectKeys& stable_if_keys()
{
  static const ObjectKeys keys{
      "",
      {{"energy_error_at_most", Number{zero_or_above}, "", none, "relative, of what a run has been given"},
       {"quantity", Text{}, "", {}, "the name of a quantity with an exact answer"},
       {"error_at_most", Number{zero_or_above}, "", none, "of that quantity"}}};
  return keys;
}

const ObjectKeys& map_sheet_keys()
{
  static const ObjectKeys keys{
      "",
      {{"name", Text{}, "", compulsory, "its title"},
       {"methods", Anything{}, "", compulsory, "a list of names of methods, whose points are its cells"},
       {"rows", Text{}, "", compulsory, "a JSON pointer that these set: a row for each value"},
       {"columns", Text{}, "", compulsory, "the same of its columns"},
       {"bound", Number{}, "", none, "the greatest value of the columns that theory allows"}}};
  return keys;
}

const ObjectKeys& map_keys()
{
  static const ObjectKeys keys{
      "",
      {{"quantity", Text{}, "", compulsory, "the name of a quantity"},
       {"noisy", Number{above_zero}, "", compulsory, "the least distance from the reference that counts as noisy"},
       {"blown", Number{above_zero}, "", compulsory, "the same of blown, as which runs without a result count too"},
       {"sheets", Objects{map_sheet_keys}, "", compulsory, "each by two settings"}}};
  return keys;
}

}  // namespace

const ObjectKeys& study_keys()
{
  constexpr int most_threads = 1024, most_repeats = 1000;
  static const ObjectKeys keys{
      "study",
      {{"title", Text{}, "", {}, "one line for people"},
       {"about", Text{}, "", {}, "what is asked, for people"},
       {"takes", Text{}, "", {}, "how long it takes, for people"},
       {"measure", Object{measure_keys}, "", compulsory, "what each point runs"},
       {"set", Anything{}, "", {}, "an object: JSON pointer → value, for all points"},
       {"methods", Objects{method_keys}, "", compulsory, "the lines of the charts"},
       {"sweep", Anything{}, "", {}, "an object: JSON pointer → list of values; every method has all combinations"},
       {"points", Objects{point_keys}, "", none, "points besides"},
       {"refine", Text{}, "", {}, "the JSON pointer along which errors should fall"},
       {"quantities", Objects{quantity_keys}, "", compulsory, "what is asked of each point"},
       {"reference", Object{reference_keys}, "", none, "what points are compared with"},
       {"budget", Object{budget_keys}, "", none, "which errors are how large"},
       {"expect", Objects{expectation_keys}, "", none, "what has to hold of the results"},
       {"stability", Object{stability_keys}, "", none,
        "of an entry of the failure catalogue: what fails, and what survives"},
       {"map", Object{map_keys}, "", none, "where runs are stable, noisy or blown"},
       {"stable_if", Object{stable_if_keys}, "", none, "what `--limit` takes for stable, besides coming to its end"},
       {"repeat", WholeNumber{1, most_repeats}, "", {3}, "timings of each point"},
       {"repeat_below_s", Number{above_zero}, "s", {60.0}, "a point that takes longer is timed once"},
       {"limit_s", Number{above_zero}, "s", none, "processor time that a point may take"},
       {"limit_times_fastest", Number{above_zero}, "", none, "the same over that of the fastest point"},
       {"threads", WholeNumber{1, most_threads}, "", {1}, "of each run"},
       {"short", Anything{}, "", {}, "laid over the study (RFC 7386) by `--short`"}}};
  return keys;
}

}  // namespace tamp::tools::study
