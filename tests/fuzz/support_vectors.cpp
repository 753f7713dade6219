#include "tests/fuzz/readers.hpp"
#include "tools/scene/materials/read_modulus.hpp"
#include "tools/scene/materials/read_support_vectors.hpp"

void tamp::fuzz::support_vectors(const std::filesystem::path& file)
{
  tools::read_support_vectors(file);
  tools::read_model_file(file, std::nullopt);
}
