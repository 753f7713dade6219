#include <hdf5.h>

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "tasks/forecast/demand.hpp"
#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_output_fields
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Paths of all that stands in a file below its first step.
std::set<std::string> paths_in(const std::filesystem::path& file)
{
  std::set<std::string> paths;
  const auto note = [](hid_t, const char* path, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::set<std::string>*>(into)->insert(path);
    return 0;
  };
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t group = H5Gopen2(opened, "step_00000000", H5P_DEFAULT);
  H5Lvisit(group, H5_INDEX_NAME, H5_ITER_INC, note, &paths);
  H5Gclose(group);
  H5Fclose(opened);
  return paths;
}

/// Paths in the field file of a run of one step of the small scene.
std::set<std::string> written_with(const std::string& assignment)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("small.json", small_scene).string();
  const std::string run = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " + file + " --quiet --steps 1 --out " + run + assignment).exit_code == 0);
  return paths_in(folder.path() / "run/fields.h5");
}

double forecast_with(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  return tasks::demand_of(tools::read_scene(folder.write("small.json", small_scene), assignments).scene).output_file;
}

}  // namespace

TEST_CASE("a field file has all fields unless some are chosen")
{
  const std::string steel = "particles/steel/";
  CHECK(written_with("") == std::set<std::string>{"nodes", "nodes/density", "nodes/velocity", "particles",
                                                  "particles/steel", steel + "id", steel + "position",
                                                  steel + "velocity", steel + "stress", steel + "p", steel + "q",
                                                  steel + "density", steel + "J", steel + "uneven_pressure",
                                                  steel + "torn_apart", "vertices"});
}

TEST_CASE("a field file has the chosen fields, ids and positions, and nothing else")
{
  const std::string steel = "particles/steel/";
  CHECK(written_with(R"( --set '/output/fields=["q","nodes/velocity"]')") ==
        std::set<std::string>{"nodes", "nodes/velocity", "particles", "particles/steel", steel + "id",
                              steel + "position", steel + "q", "vertices"});
  CHECK(written_with(" --set '/output/fields=[]'") ==
        std::set<std::string>{"particles", "particles/steel", steel + "id", steel + "position", "vertices"});
}

TEST_CASE("the size of a field file is forecast from the fields in it")
{
  constexpr double n_particles = 4, n_nodes = 9, number = 8;

  const double all = forecast_with({}), some = forecast_with({R"(/output/fields=["p","stress","nodes/density"])"});

  CHECK(all == number * (n_particles * (1 + 3 + 3 + 6 + 1 + 1 + 1 + 1 + 1 + 1) + n_nodes * (1 + 3)));
  CHECK(some == number * (n_particles * (1 + 3 + 1 + 6) + n_nodes));
}

}  // namespace test_output_fields
