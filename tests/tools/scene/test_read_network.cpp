#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

#include "runtime/file_error.hpp"
#include "tests/tools/problems.hpp"
#include "tests/tools/scene/keras_file.hpp"
#include "tests/tools/scene/small_models.hpp"
#include "tools/scene/materials/read_network.hpp"

namespace test_read_network
{

using namespace tamp;
using namespace tamp::test;
using components::Activation;
using tools::read_network_file;

namespace
{

/// Problems of a file with this content, without the folder's path.
std::string problems_of_network(const KerasFile& content, const std::string& model_config)
{
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", content, model_config);
  return problems_of_reading(folder, [&] { read_network_file(folder.path() / "n.h5"); });
}

std::string problems_of_network(const KerasFile& content)
{
  return problems_of_network(content, keras_config(content.layers).dump());
}

/// The small network after a change of its model_config.
std::string problems_with_config(const char* pointer, const nlohmann::json& value)
{
  nlohmann::json config = keras_config(small_network.layers);
  config[nlohmann::json::json_pointer(pointer)] = value;
  return problems_of_network(small_network, config.dump());
}

}  // namespace

TEST_CASE("a Keras file is read, layer by layer")
{
  for (const bool variable_strings : {false, true}) {
    const TemporaryFolder folder;
    KerasFile content = small_network;
    content.variable_strings = variable_strings;
    write_keras(folder.path() / "n.h5", content);

    const tools::NetworkFile network = read_network_file(folder.path() / "n.h5");

    REQUIRE(network.layers.size() == 4);
    CHECK(network.layers[0].activation == Activation::relu);
    CHECK(network.layers[1].activation == Activation::sigmoid);
    CHECK(network.layers[2].activation == Activation::tanh);
    CHECK(network.layers[3].activation == Activation::linear);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(network.layers[i].n_inputs == content.layers[i].n_inputs);
      CHECK(network.layers[i].n_outputs == content.layers[i].n_outputs);
      CHECK(network.layers[i].kernel == content.layers[i].kernel);
      CHECK(network.layers[i].bias == content.layers[i].bias);
    }
    CHECK(network.scaling == content.scaling);
    CHECK(network.range == content.range);
  }
}

namespace
{

/// The small network as a functional model, its layers named in the way of a Keras of that version.
nlohmann::json functional(int version)
{
  nlohmann::json config = keras_config(small_network.layers);
  config["class_name"] = version < 3 ? "Model" : "Functional";
  nlohmann::json& layers = config["config"]["layers"];
  std::string before = "input_1";
  for (nlohmann::json& layer : layers) {
    const nlohmann::json history{before, 0, 0};
    const nlohmann::json tensor{{"class_name", "__keras_tensor__"}, {"config", {{"keras_history", history}}}};
    layer["inbound_nodes"] = version < 3 ? nlohmann::json{{{before, 0, 0, nlohmann::json::object()}}}
                                         : nlohmann::json{{{"args", {tensor}}, {"kwargs", nlohmann::json::object()}}};
    before = layer["config"]["name"];
  }
  const nlohmann::json input{
      {"class_name", "InputLayer"}, {"config", {{"name", "input_1"}}}, {"inbound_nodes", nlohmann::json::array()}};
  // Their order in the file says nothing.
  layers.push_back(input);
  std::swap(layers[0], layers[2]);
  return config;
}

}  // namespace

TEST_CASE("a functional model that is a chain is read as the sequential one")
{
  const int version = GENERATE(2, 3);
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", small_network, functional(version).dump());

  const tools::NetworkFile network = read_network_file(folder.path() / "n.h5");

  REQUIRE(network.layers.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(network.layers[i].kernel == small_network.layers[i].kernel);
  CHECK(network.layers[2].activation == Activation::tanh);
}

TEST_CASE("a functional model that is no chain is refused with the layer that is beside it")
{
  nlohmann::json config = functional(2);
  // Two layers after the same one.
  config["config"]["layers"][3]["inbound_nodes"] = config["config"]["layers"][1]["inbound_nodes"];

  CHECK_THAT(problems_of_network(small_network, config.dump()),
             Catch::Contains("/inbound_nodes: [") &&
                 Catch::Contains("]; expected one input, and each layer after one other in a chain"));
}

TEST_CASE("an activation that is a layer of its own acts on the layer before it")
{
  nlohmann::json config = keras_config(small_network.layers);
  nlohmann::json& layers = config["config"]["layers"];
  const auto layer = [](const char* name) {
    return nlohmann::json{{"class_name", "Activation"}, {"config", {{"name", "a"}, {"activation", name}}}};
  };
  layers[0]["config"]["activation"] = "linear";
  layers.insert(layers.begin() + 1, layer("relu"));
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", small_network, config.dump());

  CHECK(read_network_file(folder.path() / "n.h5").layers[0].activation == Activation::relu);

  layers.insert(layers.begin() + 2, layer("tanh"));
  CHECK(problems_of_network(small_network, config.dump()) ==
        "n.h5#/model_config/config/layers/2/config/activation: tanh; expected it after a Dense layer whose own "
        "activation is linear");
}

TEST_CASE("a Keras file without scaling and range is read, and says so")
{
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", {.layers = small_network.layers});

  const tools::NetworkFile network = read_network_file(folder.path() / "n.h5");

  CHECK_FALSE(network.scaling.has_value());
  CHECK_FALSE(network.range.has_value());
}

TEST_CASE("weights of single precision are read as they are")
{
  const TemporaryFolder folder;
  KerasFile content = small_network;
  content.single_precision = true;
  write_keras(folder.path() / "n.h5", content);

  const tools::NetworkFile network = read_network_file(folder.path() / "n.h5");

  const double given = content.layers[0].kernel[0];
  CHECK(network.layers[0].kernel[0] == static_cast<double>(static_cast<float>(given)));
  CHECK(network.layers[0].kernel[0] != given);
}

TEST_CASE("the older layout of the configuration is read too")
{
  const TemporaryFolder folder;
  nlohmann::json config = keras_config(small_network.layers);
  config["config"] = nlohmann::json(config["config"]["layers"]);
  write_keras(folder.path() / "n.h5", small_network, config.dump());

  CHECK(read_network_file(folder.path() / "n.h5").layers.size() == 4);
}

TEST_CASE("a layer without bias has a bias of zero")
{
  const TemporaryFolder folder;
  KerasFile content = small_network;
  content.layers[1].bias.clear();
  write_keras(folder.path() / "n.h5", content);

  CHECK(read_network_file(folder.path() / "n.h5").layers[1].bias == std::vector<double>{0, 0});
}

TEST_CASE("layers that do nothing when the network is asked are passed over")
{
  const TemporaryFolder folder;
  nlohmann::json config = keras_config(small_network.layers);
  nlohmann::json& layers = config["config"]["layers"];
  const nlohmann::json dropout = {{"class_name", "Dropout"}, {"config", {{"name", "dropout"}, {"rate", 0.2}}}};
  layers.insert(layers.begin() + 1, dropout);
  write_keras(folder.path() / "n.h5", small_network, config.dump());

  CHECK(read_network_file(folder.path() / "n.h5").layers.size() == 4);
}

TEST_CASE("a network file that does not exist is an error of the input")
{
  CHECK_THROWS_AS(read_network_file("/no/such/network.h5"), tools::InputError);
}

TEST_CASE("a file that is no HDF5, is cut short, or holds no Keras model is reported")
{
  const TemporaryFolder folder;
  const auto text = folder.write("text.h5", "plastic_volumetric[-]\n");
  write_keras(folder.path() / "n.h5", small_network);
  const auto cut = folder.write("cut.h5", read_text(folder.path() / "n.h5").substr(0, 2000));
  const auto problems = [&](const std::filesystem::path& file) {
    return problems_of_reading(folder, [&] { read_network_file(file); });
  };

  CHECK(problems(text) == "text.h5: no HDF5 file; expected an HDF5 file");
  CHECK(problems(cut) == "cut.h5: a damaged or truncated HDF5 file; expected an HDF5 file");
  CHECK(problems_of_network(small_network, "") == "n.h5#: no attribute model_config; expected a model saved by Keras");
}

TEST_CASE("a file whose texts of variable length would be looked through for ever is refused")
{
  const TemporaryFolder folder;
  KerasFile content = small_network;
  content.variable_strings = true;
  write_keras(folder.path() / "n.h5", content);
  const std::string whole = read_text(folder.path() / "n.h5");
  const std::size_t first_object = whole.find("GCOL") + 16, size = first_object + 8;
  const auto problems_with = [&](std::size_t at, const std::string& bytes) {
    std::string damaged = whole;
    const auto file = folder.write("d.h5", damaged.replace(at, bytes.size(), bytes));
    return problems_of_reading(folder, [&] { read_network_file(file); });
  };
  const std::string damaged_texts = "d.h5: an HDF5 file whose texts are damaged; expected an HDF5 file";

  CHECK(problems_with(0, "").empty());
  CHECK(problems_with(first_object, std::string(16, '\0')) == damaged_texts);
  CHECK(problems_with(size, "\xf0" + std::string(7, '\xff')) == damaged_texts);
  CHECK(problems_with(size, std::string(8, '\xff')) == damaged_texts);
  CHECK(problems_with(size, std::string(2, '\xff')) == damaged_texts);
}

TEST_CASE("a text that is longer than what its heap holds for it is refused before memory is taken for it")
{
  const TemporaryFolder folder;
  KerasFile content = small_network;
  content.variable_strings = true;
  write_keras(folder.path() / "n.h5", content);
  std::string damaged = read_text(folder.path() / "n.h5");
  // A text is its length, the place of its heap and its number there.
  const std::uint64_t heap = damaged.find("GCOL");
  const std::uint32_t first = 1;
  std::string object(sizeof heap + sizeof first, '\0');
  std::memcpy(object.data(), &heap, sizeof heap);
  std::memcpy(object.data() + sizeof heap, &first, sizeof first);
  const std::size_t length = damaged.find(object) - sizeof(std::uint32_t);
  REQUIRE(length < damaged.size());
  const auto file = folder.write("d.h5", damaged.replace(length, 4, "\xff\xff\xff\x7f"));

  CHECK(problems_of_reading(folder, [&] { read_network_file(file); }) ==
        "d.h5: an HDF5 file whose texts are damaged; expected an HDF5 file");
}

TEST_CASE("a configuration that is none is reported with its place")
{
  CHECK(problems_of_network(small_network, "{") ==
        "n.h5#/model_config: no JSON object; expected the model's description");
  CHECK(problems_with_config("/class_name", "Mine") ==
        "n.h5#/model_config/class_name: Mine; expected Sequential, or a Functional model that is a chain");
  CHECK(problems_with_config("/config", 3) == "n.h5#/model_config/config/layers: missing; expected a list of layers");
  CHECK(problems_with_config("/config/layers/1/class_name", "Conv2D") ==
        "n.h5#/model_config/config/layers/1/class_name: Conv2D; expected Dense or Activation");
  CHECK(problems_with_config("/config/layers/0/config/activation", "swish") ==
        "n.h5#/model_config/config/layers/0/config/activation: swish; expected one of linear, relu, sigmoid, tanh");
  CHECK(problems_with_config("/config/layers/1/config/units", 0) ==
        "n.h5#/model_config/config/layers/1/config/units: 0; expected a whole number above 0");
  CHECK(problems_with_config("/config/layers/1/class_name", nullptr) ==
        "n.h5#/model_config/config/layers/1/class_name: null; expected a text");
  CHECK(problems_with_config("/config/layers/2/config/name", "other") ==
        "n.h5#/model_weights/layer_names: first, second, third, last; expected the layer other too");
}

TEST_CASE("weights whose shapes do not chain are reported with the layer")
{
  KerasFile content = small_network;
  content.layers[0] = {"first", "relu", 3, 2, {1, 2, 3, 4, 5, 6}, {0, 0}};
  CHECK(problems_of_network(content) ==
        "n.h5#/model_config/config/layers/0/config: a layer of 3 inputs; expected 2, elastic and plastic strain");

  content = small_network;
  content.layers[2] = {"third", "tanh", 3, 2, {1, 2, 3, 4, 5, 6}, {0, 0}};
  CHECK(problems_of_network(content) ==
        "n.h5#/model_config/config/layers/2/config: a layer of 3 inputs; expected 2, the outputs of the layer before");

  content = small_network;
  content.layers.pop_back();
  CHECK(problems_of_network(content) == "n.h5#/model_config/config/layers: 2 outputs; expected one, the bulk modulus");

  CHECK(problems_with_config("/config/layers/1/config/units", 5) ==
        "n.h5#/model_weights/second: a kernel of shape 2 x 2; expected its inputs x 5");

  content = small_network;
  content.layers[1].bias.push_back(0);
  CHECK(problems_of_network(content) == "n.h5#/model_weights/second: a bias of shape 3; expected 2");
}

TEST_CASE("weights that are missing or not finite are reported with their place")
{
  KerasFile content = small_network;
  content.layers[1].kernel[3] = std::nan("");
  CHECK(problems_of_network(content) ==
        "n.h5#/model_weights/second/second/kernel:0: nan as number 3; expected finite numbers");

  content = small_network;
  content.layers[1].bias.clear();
  CHECK(problems_of_network(content, keras_config(small_network.layers).dump()) ==
        "n.h5#/model_weights/second/weight_names: second/kernel:0; expected a bias too");
}

TEST_CASE("scaling and range that cannot be such are reported")
{
  KerasFile content = small_network;
  content.scaling[1] = -1;
  CHECK_THAT(problems_of_network(content), Catch::StartsWith("n.h5#/scaling: [0.03, -1, "));

  content = small_network;
  content.range = {0, 0.1, 0.3, 0.2};
  CHECK(problems_of_network(content) ==
        "n.h5#/range: [0, 0.1, 0.3, 0.2]; expected least < most elastic strain, least < most plastic strain");
}

}  // namespace test_read_network
