#include <fstream>

#include "components/errors.hpp"
#include "components/geometry/closed_mesh.hpp"
#include "tests/fuzz/readers.hpp"

void tamp::fuzz::mesh(const std::filesystem::path& file)
{
  std::ifstream stl(file, std::ios::binary);
  try {
    const components::ClosedMesh mesh(stl, 1);
    mesh.contains({0.5, 0.5, 0.5});
    mesh.volume();
  } catch (const components::BadValue&) {
  }
}
