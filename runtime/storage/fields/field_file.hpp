#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_columns.hpp"
#include "runtime/storage/fields/xdmf.hpp"
#include "runtime/storage/file_state.hpp"

namespace tamp::runtime
{

/// Particle and node fields over time: the numbers in `fields.h5`, and in `fields.xdmf` what they mean, for ParaView.
///
///     /step_00000012                      attribute "time" [s]
///     /step_00000012/particles/NAME/COLUMN
///     /step_00000012/vertices             0, 1, 2 ... as many as particles; only where no earlier step has so many
///     /step_00000012/nodes                attributes "origin" and "spacing" [m]
///     /step_00000012/nodes/COLUMN         z, y, x in the order of the dataset's dimensions
///
/// Scalars are datasets of n, vectors of n x 3, symmetric tensors of n x 6 (xx, xy, xz, yy, yz, zz); ids are 64-bit
/// whole numbers. Between two calls both files are closed and complete, so a run that is interrupted leaves what it has
/// written so far readable, and a reader may look while the run goes on.
///
/// All ranks write the one file together, and it holds the same however many they are: making one and writing a step
/// are collective, and what fails on one rank throws on all.
class FieldFile
{
 public:
  /// Starts both files anew in a folder that exists. Throws FileError.
  explicit FieldFile(const std::filesystem::path& folder, const Communicator& communicator = {});

  /// Goes on with the files of a run that is resumed after `last_step`, without what they have of later steps. There
  /// should be `n_expected` output times; a file that cannot be read is set aside as `fields.h5.damaged`. Of either,
  /// `notice` tells. Throws FileError.
  static FieldFile continued(const std::filesystem::path& folder, std::int64_t last_step, std::size_t n_expected,
                             const Communicator& communicator = {});

  /// Adds one output time; steps must not repeat. Throws FileError, for a full disk too, and std::invalid_argument for
  /// columns whose lengths do not agree.
  void write_step(std::int64_t step, double time, std::span<const ParticleBlock> particles,
                  const std::optional<NodeBlock>& nodes = std::nullopt);

  /// Throws FileError if `fields.h5` is no longer there as it was written: removed, replaced or emptied by someone
  /// else. On the first rank.
  void expect_as_written() const;

  /// Output times in the file. On the first rank.
  std::size_t n_steps() const { return steps_.size(); }

  /// A notice for the user on the file that was to be continued; empty if all was well. On the first rank.
  const std::string& notice() const { return notice_; }

 private:
  struct Unopened {
  };
  FieldFile(Unopened, const std::filesystem::path& folder, const Communicator& communicator);
  void begin() const;
  void write_xdmf() const;
  void begin_or_continue(std::int64_t last_step, std::size_t n_expected);

  std::filesystem::path hdf5_file_;
  std::filesystem::path xdmf_file_;
  Communicator communicator_;
  /// The steps in the file, and as the last one left it; on the first rank.
  std::vector<XdmfStep> steps_;
  std::optional<FileState> state_;
  std::string notice_;
};

}  // namespace tamp::runtime
