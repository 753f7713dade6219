#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "runtime/storage/field_columns.hpp"
#include "runtime/storage/xdmf.hpp"

namespace tamp::runtime
{

/// Particle and node fields over time: the numbers in `fields.h5`, and in `fields.xdmf` what they mean, for ParaView.
///
///     /step_00000012                      attribute "time" [s]
///     /step_00000012/particles/NAME/COLUMN
///     /step_00000012/nodes/COLUMN         z, y, x in the order of the dataset's dimensions
///
/// Scalars are datasets of n, vectors of n x 3, symmetric tensors of n x 6 (xx, xy, xz, yy, yz, zz); ids are 64-bit
/// whole numbers. Between two calls both files are closed and complete, so a run that is interrupted leaves what it has
/// written so far readable, and a reader may look while the run goes on.
class FieldFile
{
 public:
  /// Starts both files anew in a folder that exists. Throws FileError.
  explicit FieldFile(const std::filesystem::path& folder);

  /// Adds one output time; steps must not repeat. Throws FileError, for a full disk too, and std::invalid_argument for
  /// columns whose lengths do not agree.
  void write_step(std::int64_t step, double time, std::span<const ParticleBlock> particles,
                  const std::optional<NodeBlock>& nodes = std::nullopt);

 private:
  std::filesystem::path hdf5_file_;
  std::filesystem::path xdmf_file_;
  std::vector<XdmfStep> steps_;
};

}  // namespace tamp::runtime
