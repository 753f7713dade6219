#pragma once

#include <string>
#include <vector>

#include "tests/tools/problems.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::test
{

/// The least that a scene needs: a steel block of 1 m x 1 m on a grid of 2 x 2 cells of 1 m.
inline constexpr const char* small_scene = R"({
  "dimension": 2,
  "grid": { "upper": [2, 2], "cell_size": 1 },
  "time": { "end": 1 },
  "materials": {
    "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 10e9, "shear_modulus": 7e9 }
  },
  "bodies": {
    "block": { "material": "steel", "geometry": { "type": "box", "lower": [0, 0], "upper": [1, 1] } }
  }
})";

/// The tables of a made-up sand in small: linear, with unloading stiffer than loading.
inline void write_sand(const TemporaryFolder& folder)
{
  folder.write("sand.json", R"({
    "type": "tabular_cap", "density": 1600, "poisson_ratio": 0.2, "elastic_update": "rate",
    "modulus": { "type": "table", "table": "tables/unloading.csv" },
    "crush_curve": "tables/crush_curve.csv",
    "yield": { "file": "tables/yield.csv", "cap_ellipticity": 0.7 }
  })");
  folder.write("tables/unloading.csv",
               "# made up\nplastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
               "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.1,0,0\n0.1,0.005,1e7\n0.1,0.01,2e7\n");
  folder.write("tables/crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n0.1,2e7\n0.2,1e8\n");
  folder.write("tables/yield.csv", "pressure[Pa],sqrt_J2[Pa]\n-1e4,0\n1e6,6e5\n1e8,5e7\n");
}

/// The problems of a scene, a line for each, with the folder's own path left out; empty for a sound scene.
inline std::string problems_of(const TemporaryFolder& folder, const std::filesystem::path& file,
                               const std::vector<std::string>& assignments = {})
{
  return problems_of_reading(folder, [&] { tools::read_scene(file, assignments); });
}

/// The problems of the small scene after some assignments.
inline std::string problems_with(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  return problems_of(folder, folder.write("scene.json", small_scene), assignments);
}

/// The small scene with the small sand among its materials: in the folder "scenes" beside the sand and its tables.
inline std::filesystem::path write_scene_with_sand(const TemporaryFolder& folder)
{
  write_sand(folder);
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "../sand.json", "density": 1500 }, )");
  return folder.write("scenes/scene.json", scene);
}

inline std::string problems_with_sand(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  return problems_of(folder, write_scene_with_sand(folder), assignments);
}

}  // namespace tamp::test
