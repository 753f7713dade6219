#include <catch2/catch.hpp>

#include "tests/tools/scene/small_models.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/compiled_moduli.hpp"

namespace test_compiled_moduli
{

using namespace tamp;
using namespace tamp::test;

TEST_CASE(
    "only the materials whose modulus is compiled are reported, with type, "
    "tolerance and errors")
{
  const TemporaryFolder folder;
  write_sand(folder);
  folder.write("svr.json", small_regression);
  const std::string sand = (folder.path() / "sand.json").string(), svr = (folder.path() / "svr.json").string();
  const auto file = folder.write("scene.json", small_scene);
  const std::vector<std::string> plain{"/materials/sand/file=" + sand, "/materials/sand/modulus/type=svr",
                                       "/materials/sand/modulus/svr=" + svr};
  std::vector<std::string> compiled = plain;
  compiled.emplace_back("/materials/sand/modulus/compile=1e-3");

  const std::vector<std::string> lines = tools::compiled_moduli(tools::read_scene(file, compiled));

  CHECK(tools::compiled_moduli(tools::read_scene(file, plain)).empty());
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::StartsWith("modulus of sand: svr compiled to 0.001: ") &&
                           Catch::Contains(" patches, largest error p "));
}

}  // namespace test_compiled_moduli
