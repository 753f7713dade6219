#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <tuple>
#include <vector>

#include "runtime/data/byte_stream.hpp"
#include "runtime/execute/migration.hpp"
#include "runtime/grid/patch_layout.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::tasks
{

/// Particles that left the domain through its open faces since the start.
struct LostParticles {
  std::size_t count = 0;
  double mass = 0;                                     ///< kg
  double kinetic = 0;                                  ///< J
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< N s

  static constexpr auto fields =
      std::tuple{&LostParticles::count, &LostParticles::mass, &LostParticles::kinetic, &LostParticles::momentum};
};

/// The same kept by the patch they left from, so that the sum has the same bits for any ranks. Each rank knows that of
/// its own patches.
class LostByPatch
{
 public:
  explicit LostByPatch(int n_patches) : lost_(static_cast<std::size_t>(n_patches)) {}

  /// Counts those of a step, and clears them there.
  template <int D>
  void take(runtime::Migration& migration, const runtime::PatchLayout& layout, int n_groups);
  /// Has every rank know of every patch, as they are dealt in this layout. Collective.
  void share(const runtime::PatchLayout& layout, const runtime::Communicator& communicator);
  /// In the order of the patches; right on all ranks when it has been shared.
  LostParticles sum() const;

  void write(runtime::ByteWriter& bytes) const;
  void read(runtime::ByteReader& bytes);

 private:
  std::vector<LostParticles> lost_;
};

}  // namespace tamp::tasks
