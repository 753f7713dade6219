#pragma once

#include "tools/scene/materials/strain_measure.hpp"
#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

/// The unloading curves of a sand, columns plastic strain, elastic strain and pressure, as UnloadingTable takes them:
/// logarithmic strains, each curve from elastic strain 0 and pressure 0. The file is either
///  - text with the columns `plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]`, or
///  - published tables (published_table.hpp), for each PlasticStrainVol a curve of Pressure against TotalStrainVol or
///    ElasticStrainVol, or of BulkModulus against Pressure or ElasticStrainVol. A modulus, straight between its points,
///    is integrated from zero. What such tables hold for negative plastic strains or for tension is left out: sand goes
///    on straight there (UnloadingTable). The curve for plastic strain zero ends where it has come half way to the next
///    one.
/// Throws FileError if the file cannot be read, and InputError, with the place, for anything else.
Table read_unloading_curves(const std::filesystem::path& file, StrainMeasure measure);

}  // namespace tamp::tools
