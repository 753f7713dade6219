#pragma once

#include "tests/tools/scene/small_scene.hpp"

namespace tamp::test
{

/// A block of steel driven into a bed of sand, for a few dozen steps.
inline std::filesystem::path write_impact(const TemporaryFolder& folder)
{
  write_sand(folder);
  return folder.write("impact.json", R"({
    "dimension": 2,
    "grid": { "upper": [0.4, 0.4], "cell_size": 0.05 },
    "time": { "end": 4e-4 },
    "materials": {
      "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 10e9, "shear_modulus": 7e9 },
      "sand": { "file": "sand.json" }
    },
    "bodies": {
      "block": { "material": "steel", "geometry": { "type": "box", "lower": [0.1, 0.2], "upper": [0.3, 0.3] },
                 "velocity": [0, -20] },
      "bed": { "material": "sand", "geometry": { "type": "box", "lower": [0, 0], "upper": [0.4, 0.2] } }
    },
    "output": { "history_interval": 2e-5 }
  })");
}

}  // namespace tamp::test
