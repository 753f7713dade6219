#include "tests/fuzz/readers.hpp"
#include "tools/scene/read_modulus.hpp"
#include "tools/scene/read_network.hpp"

void tamp::fuzz::network(const std::filesystem::path& file)
{
  tools::read_network_file(file);
  tools::read_model_file(file, std::vector{0.03, 0.05, 0.2, 0.15, 2e10, 1e10});
}
