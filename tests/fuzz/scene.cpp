#include "tools/scene/read_scene.hpp"

#include "tests/fuzz/readers.hpp"

void tamp::fuzz::scene(const std::filesystem::path& file)
{
  tools::read_scene(file);
}
