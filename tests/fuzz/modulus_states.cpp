#include "tools/run/modulus/modulus_states.hpp"

#include "tests/fuzz/readers.hpp"

void tamp::fuzz::modulus_states(const std::filesystem::path& file)
{
  tools::read_modulus_states(file);
}
