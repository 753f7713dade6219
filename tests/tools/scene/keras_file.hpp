#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tamp::test
{

struct KerasLayer {
  std::string name, activation;
  std::size_t n_inputs, n_outputs;
  std::vector<double> kernel;  ///< [input][output]
  std::vector<double> bias;    ///< empty for a layer without
};

/// Content of a model file, in the layout in which Keras saves one, and what is to be odd about it.
struct KerasFile {
  std::vector<KerasLayer> layers;
  std::vector<double> scaling{}, range{};
  bool single_precision = false;
  bool variable_strings = false;
};

/// The text of the attribute model_config.
nlohmann::json keras_config(const std::vector<KerasLayer>& layers);

void write_keras(const std::filesystem::path& file, const KerasFile& content, const std::string& model_config);
void write_keras(const std::filesystem::path& file, const KerasFile& content);

}  // namespace tamp::test
