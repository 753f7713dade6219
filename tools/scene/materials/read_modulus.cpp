#include "tools/scene/materials/read_modulus.hpp"

#include <fmt/core.h>

#include <functional>

#include "components/errors.hpp"
#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/json/parameter_keys.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/materials/read_network.hpp"
#include "tools/scene/materials/read_support_vectors.hpp"
#include "tools/scene/materials/unloading_curves.hpp"

namespace tamp::tools
{

namespace
{

using components::BadValue;
using components::EngineeringStrain;
using components::Modulus;
using components::ModulusSurface;
using components::NetworkModulus;
using components::SupportVectorModulus;
using components::UnloadingTable;

UnloadingTable unloading_table(const std::filesystem::path& file, StrainMeasure measure)
{
  Table curves = read_unloading_curves(file, measure);
  return made_from(curves, [](Table& t) { return UnloadingTable(t.columns[0], t.columns[1], t.columns[2]); });
}

/// The result of `make`; its BadValue becomes an InputError at `place`.
template <class Make>
auto made_at(const std::string& place, Make make)
{
  try {
    return make();
  } catch (const BadValue& bad) {
    throw InputError({place, bad.found, "expected " + bad.expected});
  }
}

SupportVectorModulus support_vector_modulus(const std::filesystem::path& file, components::ZeroPressure zero)
{
  const components::SupportVectorFit fit = read_support_vectors(file);
  return made_at(file.string(), [&] { return SupportVectorModulus(fit, zero); });
}

NetworkModulus network_modulus(const std::filesystem::path& file, std::vector<components::DenseLayer> layers,
                               const std::vector<double>& scaling, const std::vector<double>& range)
{
  const components::NetworkFit fit = network_fit(std::move(layers), scaling, range);
  return made_at(file.string(), [&] { return NetworkModulus(fit); });
}

/// Reads the keys first, and the file they name when they are good.
class ModulusReader
{
 public:
  ModulusReader(JsonReader& material, StrainMeasure measure) : reader_(material.object("modulus")), measure_(measure) {}

  std::optional<Modulus> read()
  {
    const std::size_t n_before = reader_.document().problems.size();
    read_keys();
    if (reader_.document().problems.size() > n_before || !make_) return std::nullopt;
    return noting_problems(reader_.document(), make_);
  }

 private:
  void read_keys()
  {
    const std::string type = reader_.word("type");
    components::for_each_named_modulus([&]<class Model>(std::type_identity<Model>) {
      if (type == Model::type) {
        read_keys_of<Model>();
      } else if constexpr (requires { Model::file; }) {
        reader_.pass_over_file(std::string(Model::type));
      }
    });
    tolerance_ = reader_.optional_number("compile");
    scaling_ = reader_.optional_numbers("scaling");
    range_ = reader_.optional_numbers("range");
    reader_.finish();
  }

  /// Reads the keys of the model that is chosen, from which `make_` then makes it.
  template <class Model>
  void read_keys_of()
  {
    if constexpr (requires { Model::file; }) {
      const std::filesystem::path file = reader_.existing_file(std::string(Model::type));
      if (!file.empty()) make_ = [this, file] { return converted(model_of_file<Model>(file)); };
    } else {
      Model model{};
      read_parameters(reader_, model);
      make_ = [this, model] { return converted(model); };
    }
  }

  template <class Model>
  Model model_of_file(const std::filesystem::path& file) const;

  std::vector<double> in_file_or_here(const std::string& key, std::size_t n, const std::filesystem::path& file,
                                      const std::optional<std::vector<double>>& in_file,
                                      const std::optional<std::vector<double>>& here) const
  {
    if (in_file) return *in_file;
    if (here) return *here;
    throw InputError({reader_.place(key), fmt::format("missing, and not in {} either", file.string()),
                      fmt::format("expected {} numbers", n)});
  }

  /// A model that was fitted to strains knows its own only.
  template <components::ElasticModel Model>
  Modulus converted(Model model) const
  {
    if constexpr (requires { Modulus(EngineeringStrain<Model>(model)); }) {
      if (measure_ == StrainMeasure::engineering) return compiled(EngineeringStrain<Model>(std::move(model)));
    }
    return compiled(std::move(model));
  }

  template <components::ElasticModel Model>
  Modulus compiled(Model model) const
  {
    if (!tolerance_) return model;
    return made_at(reader_.place("compile"), [&] { return ModulusSurface(model, *tolerance_); });
  }

  JsonReader reader_;
  StrainMeasure measure_;
  std::function<Modulus()> make_;
  std::optional<double> tolerance_;
  std::optional<std::vector<double>> scaling_, range_;
};

template <>
UnloadingTable ModulusReader::model_of_file(const std::filesystem::path& file) const
{
  return unloading_table(file, measure_);
}

template <>
SupportVectorModulus ModulusReader::model_of_file(const std::filesystem::path& file) const
{
  return support_vector_modulus(file, components::ZeroPressure::at_zero_elastic_strain);
}

template <>
NetworkModulus ModulusReader::model_of_file(const std::filesystem::path& file) const
{
  NetworkFile network = read_network_file(file);
  const std::vector<double> scaling = in_file_or_here("scaling", 6, file, network.scaling, scaling_);
  const std::vector<double> range = in_file_or_here("range", 4, file, network.range, range_);
  check_scaling(scaling, reader_.place("scaling"));
  check_range(range, reader_.place("range"));
  return network_modulus(file, std::move(network.layers), scaling, range);
}

Modulus network_of_file(const std::filesystem::path& file, const std::optional<std::vector<double>>& scaling)
{
  NetworkFile network = read_network_file(file);
  if (!network.scaling) network.scaling = scaling;
  if (!network.scaling) {
    throw InputError({file.string(), "a network without the attribute scaling",
                      "expected --scaling mean_e,sd_e,mean_p,sd_p,mean_K,sd_K"});
  }
  const std::vector<double> range = network.range.value_or(likely_range(*network.scaling));
  return network_modulus(file, std::move(network.layers), *network.scaling, range);
}

}  // namespace

std::optional<Modulus> read_modulus(JsonReader& material, StrainMeasure measure)
{
  return ModulusReader(material, measure).read();
}

Modulus read_model_file(const std::filesystem::path& file, const std::optional<std::vector<double>>& scaling)
{
  const FileKind kind = file_kind(file);
  if (kind == FileKind::hdf5) return network_of_file(file, scaling);
  if (scaling) throw InputError({file.string(), "no network", "expected one where --scaling is given"});
  if (kind == FileKind::text) return unloading_table(file, StrainMeasure::logarithmic);

  const Json root = parse_json(file);
  if (root.contains("Vaango_tabular_data")) return unloading_table(file, StrainMeasure::logarithmic);
  if (root.contains("support_vectors") || root.contains("dual_coeffs") || root.contains("gamma")) {
    return support_vector_modulus(file, components::ZeroPressure::as_fitted);
  }
  throw InputError({file.string() + "#", "no model", "expected Vaango_tabular_data, support_vectors or a material"});
}

}  // namespace tamp::tools
