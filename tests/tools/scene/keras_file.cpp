#include "tests/tools/scene/keras_file.hpp"

#include <algorithm>

#include "runtime/storage/hdf5.hpp"

namespace tamp::test
{

namespace
{

namespace hdf5 = runtime::hdf5;
using Datatype = hdf5::Handle<H5Tclose>;

void write_attribute(hid_t object, const char* name, hid_t type, hsize_t n, const void* values)
{
  const hdf5::Space space(H5Screate_simple(1, &n, nullptr));
  const hdf5::Attribute attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  H5Awrite(attribute, type, values);
}

void write_texts(hid_t object, const char* name, const std::vector<std::string>& texts, bool variable)
{
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  const Datatype type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, variable ? H5T_VARIABLE : width);
  if (variable) {
    std::vector<const char*> fields;
    fields.reserve(texts.size());
    for (const std::string& text : texts) fields.push_back(text.c_str());
    write_attribute(object, name, type, fields.size(), fields.data());
  } else {
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    std::string fields;
    for (const std::string& text : texts) fields += text + std::string(width - text.size(), '\0');
    write_attribute(object, name, type, texts.size(), fields.data());
  }
}

void write_dataset(hid_t group, const char* name, const std::vector<hsize_t>& extents,
                   const std::vector<double>& numbers, hid_t type)
{
  const hdf5::Space space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
  const hdf5::Dataset dataset(H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
}

hdf5::Group make_group(hid_t parent, const std::string& name)
{
  return hdf5::Group(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

void write_layer(hid_t weights, const KerasLayer& layer, const KerasFile& content)
{
  const hid_t type = content.single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  const hdf5::Group outer = make_group(weights, layer.name), inner = make_group(outer, layer.name);
  std::vector<std::string> names{layer.name + "/kernel:0"};
  write_dataset(inner, "kernel:0", {layer.n_inputs, layer.n_outputs}, layer.kernel, type);
  if (!layer.bias.empty()) {
    names.push_back(layer.name + "/bias:0");
    write_dataset(inner, "bias:0", {layer.bias.size()}, layer.bias, type);
  }
  write_texts(outer, "weight_names", names, content.variable_strings);
}

}  // namespace

nlohmann::json keras_config(const std::vector<KerasLayer>& layers)
{
  nlohmann::json list = nlohmann::json::array();
  for (const KerasLayer& layer : layers) {
    list.push_back({{"class_name", "Dense"},
                    {"config",
                     {{"name", layer.name},
                      {"units", layer.n_outputs},
                      {"activation", layer.activation},
                      {"use_bias", !layer.bias.empty()}}}});
  }
  return {{"class_name", "Sequential"}, {"config", {{"name", "sequential"}, {"layers", list}}}};
}

void write_keras(const std::filesystem::path& file, const KerasFile& content, const std::string& model_config)
{
  const hdf5::Quiet quiet;
  const hdf5::File id(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!model_config.empty()) write_texts(id, "model_config", {model_config}, content.variable_strings);
  for (const auto& [name, numbers] : {std::pair{"scaling", &content.scaling}, std::pair{"range", &content.range}}) {
    if (!numbers->empty()) write_attribute(id, name, H5T_NATIVE_DOUBLE, numbers->size(), numbers->data());
  }
  const hdf5::Group weights = make_group(id, "model_weights");
  std::vector<std::string> names;
  for (const KerasLayer& layer : content.layers) {
    names.push_back(layer.name);
    write_layer(weights, layer, content);
  }
  write_texts(weights, "layer_names", names, content.variable_strings);
}

void write_keras(const std::filesystem::path& file, const KerasFile& content)
{
  write_keras(file, content, keras_config(content.layers).dump());
}

}  // namespace tamp::test
