#include "tasks/report/lost_particles.hpp"

#include <cstring>
#include <span>

#include "runtime/data/combine.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

template <int D>
void LostByPatch::take(runtime::Migration& migration, const runtime::PatchLayout& layout, int n_groups)
{
  for (const runtime::Patch& patch : layout) {
    LostParticles& lost = lost_[static_cast<std::size_t>(patch.id)];
    for (int g = 0; g < n_groups; ++g) {
      if (migration.n_lost(patch.id, g) == 0) continue;
      const auto mass = migration.lost(particle::mass, patch.id, g);
      const auto velocity = migration.lost(particle::velocity<D>, patch.id, g);
      lost.count += mass.size();
      for (std::size_t p = 0; p < mass.size(); ++p) {
        lost.mass += mass[p];
        lost.kinetic += 0.5 * mass[p] * velocity[p].squaredNorm();
        lost.momentum.template head<D>() += mass[p] * velocity[p];
      }
    }
  }
  migration.clear_lost();
}

template void LostByPatch::take<2>(runtime::Migration&, const runtime::PatchLayout&, int);
template void LostByPatch::take<3>(runtime::Migration&, const runtime::PatchLayout&, int);

void LostByPatch::share(const runtime::PatchLayout& layout, const runtime::Communicator& communicator)
{
  const auto from_each = communicator.gather(std::as_bytes(std::span(lost_)));
  for (const runtime::Patch& patch : layout) {
    const auto p = static_cast<std::size_t>(patch.id);
    const auto& bytes = from_each[static_cast<std::size_t>(patch.rank)];
    std::memcpy(static_cast<void*>(&lost_[p]), bytes.data() + p * sizeof(LostParticles), sizeof(LostParticles));
  }
}

LostParticles LostByPatch::sum() const
{
  LostParticles sum;
  for (const LostParticles& lost : lost_) runtime::combine(sum, lost);
  return sum;
}

void LostByPatch::write(runtime::ByteWriter& bytes) const
{
  for (const LostParticles& lost : lost_) bytes.add(lost);
}

void LostByPatch::read(runtime::ByteReader& bytes)
{
  for (LostParticles& lost : lost_) bytes.read(lost);
}

}  // namespace tamp::tasks
