#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "components/moduli/modulus.hpp"
#include "tools/scene/json/json_reader.hpp"
#include "tools/scene/materials/strain_measure.hpp"

namespace tamp::tools
{

/// Reads the "modulus" of a material: "type" names a model (modulus.hpp), whose file stands under the type's name.
/// Empty if there is a problem, which the reader's document then knows.
std::optional<components::Modulus> read_modulus(JsonReader& material, StrainMeasure measure);

/// Reads a model's file by itself: unloading curves, a published table, support-vector regression or Keras network, in
/// the strains of the file. A network that does not hold its scaling needs `scaling` (NetworkFile). Throws FileError if
/// the file cannot be read, and InputError for what is no such model.
components::Modulus read_model_file(const std::filesystem::path& file,
                                    const std::optional<std::vector<double>>& scaling);

}  // namespace tamp::tools
