#include "tools/scene/materials/read_network.hpp"

#include "components/errors.hpp"
#include "tests/fuzz/readers.hpp"

/// Without the surface that is made of a network in the end, which takes seconds under the sanitizers.
void tamp::fuzz::network(const std::filesystem::path& file)
{
  tools::NetworkFile network = tools::read_network_file(file);
  const std::vector<double> scaling = network.scaling.value_or(std::vector{0.03, 0.05, 0.2, 0.15, 2e10, 1e10});
  const std::vector<double> range = network.range.value_or(tools::likely_range(scaling));
  try {
    tools::network_fit(std::move(network.layers), scaling, range);
  } catch (const components::BadValue&) {
  }
}
