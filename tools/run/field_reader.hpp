#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/storage/hdf5.hpp"

namespace tamp::tools
{

/// A particle as it stands in a field file; `velocity` is nan where the file has none.
struct StoredParticle {
  Eigen::Vector3d position;
  Eigen::Vector3d velocity;
};

/// Reads where the particles of a run were at its outputs, a part of them at a time. All throws FileError, for what is
/// not as a run has written it too.
class FieldReader
{
 public:
  explicit FieldReader(const std::filesystem::path& field_file);

  /// The names of its outputs, from first to last.
  const std::vector<std::string>& outputs() const { return outputs_; }
  /// When an output was made [s].
  double time(const std::string& output) const;
  /// The materials that have particles there.
  std::vector<std::string> materials(const std::string& output) const;
  /// Calls `look` with each particle of a material that has a position.
  void for_each(const std::string& output, const std::string& material,
                const std::function<void(const StoredParticle&)>& look) const;

 private:
  runtime::hdf5::OpenFile file_;
  std::vector<std::string> outputs_;
};

}  // namespace tamp::tools
