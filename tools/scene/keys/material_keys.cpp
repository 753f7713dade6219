#include <fmt/core.h>

#include "components/materials/material_model.hpp"
#include "tools/scene/json/keys.hpp"
#include "tools/scene/json/parameter_keys.hpp"
#include "tools/scene/materials/strain_measure.hpp"
#include "tools/scene/materials/yield_table.hpp"

namespace tamp::tools
{

namespace
{

constexpr Range within_one{.lower = 0, .upper = 1, .holds_lower = false, .holds_upper = false};

/// A text on each model that a scene can name, one after another: `text(std::type_identity<Model>())` of each.
template <class Text>
std::string of_each_modulus(Text text)
{
  std::string all;
  components::for_each_named_modulus([&](auto model) {
    const std::string own = text(model);
    all += (all.empty() || own.empty() ? "" : "; ") + own;
  });
  return all;
}

/// The words of the models, and what each consists of: its file, under its word, or its numbers.
std::vector<Key> model_keys()
{
  const Default of_type{nullptr, "that of the type is compulsory"};
  const std::string meanings = of_each_modulus(
      []<class Model>(std::type_identity<Model>) { return fmt::format("`\"{}\"`: {}", Model::type, Model::meaning); });
  const std::string files = of_each_modulus([]<class Model>(std::type_identity<Model>) -> std::string {
    if constexpr (requires { Model::file; }) return std::string(Model::file);
    return {};
  });
  Choice types;
  std::vector<Key> keys{{"type", {}, "", compulsory, meanings + "; see [moduli.md](../explanation/moduli.md)"}};
  components::for_each_named_modulus([&]<class Model>(std::type_identity<Model>) {
    const std::string type(Model::type);
    types.words.push_back(type);
    if constexpr (requires { Model::file; }) {
      keys.push_back({type, File{}, "", of_type, "the model's file: " + files});
    } else {
      for (Key& key : keys_of_parameters<Model>()) {
        if (key.default_value.compulsory) key.default_value = {nullptr, "compulsory for `\"" + type + "\"`"};
        keys.push_back(std::move(key));
      }
    }
  });
  keys.front().value = std::move(types);
  return keys;
}

const ObjectKeys& modulus_keys()
{
  const std::string numbers =
      "of an mlp: `[mean_e, sd_e, mean_p, sd_p, mean_K, sd_K]`, `[e_lower, e_upper, p_lower, p_upper]` for elastic (e) "
      "and plastic (p) strain";
  const Default in_file{nullptr, "those in the file"};
  static const ObjectKeys keys = [&] {
    ObjectKeys all{"", model_keys()};
    all.keys.push_back({"compile",
                        Number{within_one},
                        "",
                        {nullptr, "off"},
                        "tolerance to which the model is turned into one bicubic surface when it is read"});
    all.keys.push_back({"scaling", Numbers{just(6)}, "", in_file, numbers});
    all.keys.push_back({"range", Numbers{just(4)}, "", in_file, numbers});
    return all;
  }();
  return keys;
}

const ObjectKeys& yield_keys()
{
  Key measure =
      choice<YieldMeasure>("measure", YieldMeasure::q, {{"q", YieldMeasure::q}, {"sqrt_J2", YieldMeasure::sqrt_J2}},
                           "what a published JSON's column `SqrtJ2` holds, as its name is no proof: `\"q\"`, "
                           "sqrt(3 J2), or `\"sqrt_J2\"`; a table of our own says it in its heading");
  measure.default_value = {nullptr, "that of the heading; compulsory for a published JSON"};
  static const ObjectKeys keys{
      "",
      {{"file", File{}, "", compulsory,
        "table `pressure[Pa]` and either `q[Pa]` = sqrt(3 J2) or `sqrt_J2[Pa]`; its first row is the tension "
        "vertex. The surface is the upper concave hull of the rows, see [sand.md](../explanation/sand.md#sand)"},
       std::move(measure),
       {"cap_ellipticity", Number{within_one}, "", compulsory,
        "where the cap starts, between the tension vertex (0) and the crush pressure (1)"}}};
  return keys;
}

/// A model that consists of numbers says itself what they are.
template <class Model>
std::vector<Key> keys_of()
{
  return keys_of_parameters<Model>();
}

template <>
std::vector<Key> keys_of<components::BoltonSand>()
{
  std::vector<Key> keys = keys_of_parameters<components::BoltonSand>();
  keys.insert(keys.begin(), {"relative_density", Number{{.lower = 0, .upper = 1}}, "", none,
                             "I_D = (e_max - e) / (e_max - e_min), from 0, loosest, to 1, densest: in place of "
                             "`density`, which then follows from it"});
  return keys;
}

template <>
std::vector<Key> keys_of<components::TabularCap>()
{
  using components::ElasticUpdate, components::TabularCapParameters;
  constexpr int most_substeps = 1'000'000;
  const std::vector<components::Word<StrainMeasure>> strains{{"logarithmic", StrainMeasure::logarithmic},
                                                             {"engineering", StrainMeasure::engineering}};
  Key tested_strain = choice<StrainMeasure>(
      "tested_strain", StrainMeasure::logarithmic, strains,
      "which strains the tests measured; `tamp check` warns where `strain_measure` reads them as others");
  tested_strain.default_value = none;
  return {
      {"poisson_ratio", Number{{.lower = -1, .upper = 0.5, .holds_lower = false, .holds_upper = false}}, "", compulsory,
       "gives the shear modulus from the bulk modulus"},
      choice<ElasticUpdate>("elastic_update", ElasticUpdate::state,
                            {{"state", ElasticUpdate::state}, {"rate", ElasticUpdate::rate}},
                            "`\"state\"`: pressure is a function of elastic and plastic strain; `\"rate\"`: the "
                            "pressure's rate is the bulk modulus times the elastic strain rate, as published"),
      {"modulus", Object{modulus_keys}, "", compulsory, ""},
      choice<StrainMeasure>(
          "strain_measure", StrainMeasure::logarithmic, strains,
          "how the measured volumetric strains are read: `\"logarithmic\"` takes the numbers as -ln(V/V0), as the "
          "published tables do; `\"engineering\"` as 1 - V/V0"),
      std::move(tested_strain),
      {"tested_density", Number{above_zero}, "kg/m^3", none,
       "of the samples that were tested; `tamp check` warns of a scene whose density differs by more than 5 %"},
      {"hydrostat",
       File{},
       "",
       {nullptr, "compulsory in state form"},
       "table `total_volumetric[-]`, `pressure[Pa]` of hydrostatic loading, from which the crush curve then "
       "follows"},
      {"crush_curve",
       File{},
       "",
       {nullptr, "compulsory in rate form"},
       "table `plastic_volumetric[-]`, `pressure[Pa]`: hydrostatic strength"},
      {"yield", Object{yield_keys}, "", compulsory, ""},
      {"tolerance",
       Number{{.lower = 0, .upper = 1, .holds_lower = false}},
       "",
       {TabularCapParameters::usual_tolerance},
       "relative error of the stress in one step, above which a step is cut into substeps"},
      {"max_substeps",
       WholeNumber{1, most_substeps},
       "",
       {TabularCapParameters::usual_max_substeps},
       "substeps that one step may be cut into"},
      {"separation",
       Flag{},
       "",
       {false},
       "whether sand that is torn bears no stress until it is back at the volume that it had then, see "
       "[sand.md](../explanation/sand.md#sand-that-separates)",
       0,
       "comes_apart"},
      {"separation_density",
       Number{{.lower = 0, .upper = 1, .holds_lower = false}},
       "",
       {TabularCapParameters::usual_separation_density},
       "part of the initial density below which sand that may separate does so"},
      {"dilation_limit", Number{components::zero_or_above}, "", none,
       "plastic volumetric expansion since the start beyond which shear widens the sand no more; none as "
       "published"},
      {"gaps",
       Flag{},
       "",
       {false},
       "whether sand that is torn, at any density, bears and resists nothing until the gaps have closed, of which it "
       "keeps no volume, as other soil with `separation` does"}};
}

template <class... Model>
std::vector<TypeKeys> types_of(const std::variant<Model...>*)
{
  return {{std::string(Model::type), keys_of<Model>()}...};
}

}  // namespace

const ObjectKeys& material_keys()
{
  static const ObjectKeys keys{.name = "material",
                               .keys = {{"density",
                                         Number{above_zero},
                                         "kg/m^3",
                                         {nullptr, "compulsory, but with `relative_density`"},
                                         "of the unstrained material"},
                                        {"particles_per_axis",
                                         WholeNumber{1, most_particles_per_axis},
                                         "",
                                         {nullptr, "the scene's"},
                                         "the number of its particles along each axis of a cell"}},
                               .types = types_of(static_cast<const components::MaterialModel*>(nullptr)),
                               .may_be_a_file = true};
  return keys;
}

}  // namespace tamp::tools
