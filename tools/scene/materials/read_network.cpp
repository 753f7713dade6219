#include "tools/scene/materials/read_network.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "tools/scene/files/hdf5_input.hpp"
#include "tools/scene/json/document.hpp"
#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

namespace
{

using components::Activation;
using components::DenseLayer;

constexpr const char* config_name = "model_config";
constexpr const char* weights_group = "/model_weights";

constexpr std::array<std::pair<const char*, Activation>, 4> activations{{{"linear", Activation::linear},
                                                                         {"relu", Activation::relu},
                                                                         {"sigmoid", Activation::sigmoid},
                                                                         {"tanh", Activation::tanh}}};

/// Layers that do nothing to two numbers when a network is asked.
bool is_idle(const std::string& class_name)
{
  return class_name == "InputLayer" || class_name == "Dropout" || class_name == "Flatten";
}

class KerasReader
{
 public:
  explicit KerasReader(const std::filesystem::path& file) : input_(file) {}

  NetworkFile read()
  {
    NetworkFile network;
    read_config();
    layer_names_ = input_.texts(weights_group, "layer_names");
    const JsonPointer pointer = layers_pointer();
    for (const JsonPointer& layer : is_sequential() ? listed(pointer) : chained(pointer)) {
      const std::string class_name = text(layer / "class_name");
      if (is_idle(class_name)) continue;
      if (class_name == "Activation") {
        activate(network.layers, layer / "config" / "activation");
        continue;
      }
      if (class_name != "Dense") fail(layer / "class_name", class_name, "expected Dense or Activation");
      network.layers.push_back(read_layer(layer / "config"));
      check_chain(network.layers, layer / "config");
    }
    if (network.layers.empty()) fail(pointer, "no layers", "expected Dense layers");
    if (network.layers.back().n_outputs != 1) {
      fail(pointer, fmt::format("{} outputs", network.layers.back().n_outputs), "expected one, the bulk modulus");
    }
    network.scaling = input_.numbers("/", "scaling");
    network.range = input_.numbers("/", "range");
    if (network.scaling) check_scaling(*network.scaling, input_.place("/", "scaling"));
    if (network.range) check_range(*network.range, input_.place("/", "range"));
    return network;
  }

 private:
  /// `pointer` leads into the JSON of the attribute model_config.
  [[noreturn]] void fail(const JsonPointer& pointer, const std::string& found, const std::string& expected) const
  {
    throw InputError({input_.place("/", config_name) + pointer.to_string(), found, expected});
  }

  std::string text(const JsonPointer& pointer) const
  {
    if (config_.contains(pointer) && config_[pointer].is_string()) return config_[pointer].get<std::string>();
    fail(pointer, shown(pointer), "expected a text");
  }

  std::size_t count(const JsonPointer& pointer) const
  {
    const bool is_count = config_.contains(pointer) && config_[pointer].is_number_unsigned();
    if (is_count && config_[pointer] > 0) return config_[pointer].get<std::size_t>();
    fail(pointer, shown(pointer), "expected a whole number above 0");
  }

  std::string shown(const JsonPointer& pointer) const
  {
    return config_.contains(pointer) ? config_[pointer].dump() : "missing";
  }

  void read_config()
  {
    if (!input_.has_attribute("/", config_name)) {
      throw InputError({input_.place("/"), "no attribute model_config", "expected a model saved by Keras"});
    }
    const std::vector<std::string> texts = input_.texts("/", config_name);
    config_ = json_of(texts.empty() ? "" : texts.front()).value_or(nullptr);
    if (!config_.is_object()) fail(JsonPointer(), "no JSON object", "expected the model's description");
    const JsonPointer class_name = JsonPointer() / "class_name";
    const std::string kind = text(class_name);
    if (kind != "Sequential" && kind != "Functional" && kind != "Model") {
      fail(class_name, kind, "expected Sequential, or a Functional model that is a chain");
    }
  }

  bool is_sequential() const { return text(JsonPointer() / "class_name") == "Sequential"; }

  std::vector<JsonPointer> listed(const JsonPointer& layers) const
  {
    std::vector<JsonPointer> all;
    for (std::size_t i = 0; i < config_[layers].size(); ++i) all.push_back(layers / i);
    return all;
  }

  /// The layers of a functional model in the order in which they follow each other; refused if they do not all.
  std::vector<JsonPointer> chained(const JsonPointer& layers) const
  {
    std::vector<JsonPointer> left = listed(layers), chain;
    std::vector<std::string> before;
    while (!left.empty()) {
      const auto next = std::find_if(left.begin(), left.end(), [&](const auto& l) { return inputs_of(l) == before; });
      if (next == left.end()) {
        fail(left.front() / "inbound_nodes", fmt::format("[{}]", fmt::join(inputs_of(left.front()), ", ")),
             "expected one input, and each layer after one other in a chain");
      }
      before = {text(*next / "config" / "name")};
      chain.push_back(*next);
      left.erase(next);
    }
    return chain;
  }

  std::vector<std::string> inputs_of(const JsonPointer& layer) const
  {
    std::vector<std::string> names;
    const JsonPointer nodes = layer / "inbound_nodes";
    if (config_.contains(nodes)) collect_inputs(config_[nodes], names);
    return names;
  }

  /// A layer stands there as ["name", 0, 0, {}], since Keras 3 under "keras_history".
  static void collect_inputs(const Json& node, std::vector<std::string>& names)
  {
    if (node.is_array() && !node.empty() && node.front().is_string()) {
      names.push_back(node.front().get<std::string>());
    } else if (node.is_object() && node.contains("keras_history")) {
      collect_inputs(node["keras_history"], names);
    } else if (node.is_structured()) {
      for (const Json& inner : node) collect_inputs(inner, names);
    }
  }

  /// A layer that is an activation alone acts on the one before it.
  void activate(std::vector<DenseLayer>& layers, const JsonPointer& pointer) const
  {
    const Activation own = activation(pointer);
    if (own == Activation::linear) return;
    if (layers.empty() || layers.back().activation != Activation::linear) {
      fail(pointer, text(pointer), "expected it after a Dense layer whose own activation is linear");
    }
    layers.back().activation = own;
  }

  /// The list of layers stands under "layers" since Keras 2.2.3, before that directly.
  JsonPointer layers_pointer() const
  {
    const JsonPointer direct = JsonPointer() / "config", inside = direct / "layers";
    if (config_.contains(inside) && config_[inside].is_array()) return inside;
    if (config_.contains(direct) && config_[direct].is_array()) return direct;
    fail(inside, "missing", "expected a list of layers");
  }

  DenseLayer read_layer(const JsonPointer& pointer) const
  {
    const std::string name = text(pointer / "name");
    const std::string group = fmt::format("{}/{}", weights_group, name);
    if (std::find(layer_names_.begin(), layer_names_.end(), name) == layer_names_.end()) {
      throw InputError({input_.place(weights_group, "layer_names"), fmt::format("{}", fmt::join(layer_names_, ", ")),
                        fmt::format("expected the layer {} too", name)});
    }
    DenseLayer layer{};
    layer.activation = activation(pointer / "activation");
    layer.n_outputs = count(pointer / "units");

    const std::vector<std::string> weights = input_.texts(group, "weight_names");
    Hdf5Array kernel = weight(group, weights, "kernel");
    if (kernel.extents.size() != 2 || kernel.extents[1] != layer.n_outputs) {
      throw InputError({input_.place(group), fmt::format("a kernel of shape {}", fmt::join(kernel.extents, " x ")),
                        fmt::format("expected its inputs x {}", layer.n_outputs)});
    }
    layer.n_inputs = kernel.extents[0];
    layer.kernel = std::move(kernel.numbers);
    layer.bias = bias(pointer, group, weights, layer.n_outputs);
    return layer;
  }

  Activation activation(const JsonPointer& pointer) const
  {
    if (!config_.contains(pointer)) return Activation::linear;
    const std::string name = text(pointer);
    const auto at =
        std::find_if(activations.begin(), activations.end(), [&](const auto& a) { return a.first == name; });
    if (at == activations.end()) fail(pointer, name, "expected one of linear, relu, sigmoid, tanh");
    return at->second;
  }

  std::vector<double> bias(const JsonPointer& layer, const std::string& group, const std::vector<std::string>& weights,
                           std::size_t n) const
  {
    const JsonPointer use_bias = layer / "use_bias";
    if (config_.contains(use_bias) && config_[use_bias] == false) return std::vector<double>(n, 0);
    Hdf5Array bias = weight(group, weights, "bias");
    if (bias.extents == std::vector<std::size_t>{n}) return std::move(bias.numbers);
    throw InputError({input_.place(group), fmt::format("a bias of shape {}", fmt::join(bias.extents, " x ")),
                      fmt::format("expected {}", n)});
  }

  /// The dataset whose name is `kind`, whatever stands before it as a path and after it as a number: "dense/kernel:0".
  Hdf5Array weight(const std::string& group, const std::vector<std::string>& weights, const std::string& kind) const
  {
    for (const std::string& name : weights) {
      const std::string_view last = std::string_view(name).substr(name.rfind('/') + 1);
      if (last.substr(0, last.find(':')) == kind) return input_.dataset(fmt::format("{}/{}", group, name));
    }
    throw InputError({input_.place(group, "weight_names"), fmt::format("{}", fmt::join(weights, ", ")),
                      fmt::format("expected a {} too", kind)});
  }

  void check_chain(const std::vector<DenseLayer>& layers, const JsonPointer& pointer) const
  {
    const std::size_t n = layers.size() == 1 ? 2 : layers[layers.size() - 2].n_outputs;
    if (layers.back().n_inputs == n) return;
    fail(pointer, fmt::format("a layer of {} inputs", layers.back().n_inputs),
         layers.size() == 1 ? "expected 2, elastic and plastic strain"
                            : fmt::format("expected {}, the outputs of the layer before", n));
  }

  Hdf5Input input_;
  Json config_;
  std::vector<std::string> layer_names_;
};

[[noreturn]] void fail(const std::vector<double>& numbers, const std::string& place, const std::string& expected)
{
  throw InputError({place, fmt::format("[{}]", fmt::join(numbers, ", ")), expected});
}

}  // namespace

NetworkFile read_network_file(const std::filesystem::path& file)
{
  return KerasReader(file).read();
}

void check_scaling(const std::vector<double>& scaling, const std::string& place)
{
  const std::string expected = "expected mean and deviation (none negative) of elastic strain, plastic strain and K";
  if (scaling.size() != 6) fail(scaling, place, expected);
  for (std::size_t i = 1; i < scaling.size(); i += 2) {
    if (scaling[i] < 0) fail(scaling, place, expected);
  }
}

void check_range(const std::vector<double>& range, const std::string& place)
{
  const bool is_good = range.size() == 4 && range[0] < range[1] && range[2] < range[3];
  if (!is_good) fail(range, place, "expected least < most elastic strain, least < most plastic strain");
}

std::vector<double> likely_range(const std::vector<double>& scaling)
{
  return {0, scaling[0] + 2 * scaling[1], 0, scaling[2] + 2 * scaling[3]};
}

components::NetworkFit network_fit(std::vector<DenseLayer> layers, const std::vector<double>& scaling,
                                   const std::vector<double>& range)
{
  return {std::move(layers),
          {scaling[0], scaling[1]},
          {scaling[2], scaling[3]},
          {scaling[4], scaling[5]},
          {range[0], range[1], range[2], range[3]}};
}

}  // namespace tamp::tools
