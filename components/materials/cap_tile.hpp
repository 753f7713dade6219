#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "components/materials/cap_integrator.hpp"
#include "components/materials/cap_lanes.hpp"
#include "components/packs.hpp"

namespace tamp::components
{

/// The steps of up to `size` particles of sand, side by side: each round tries one substep of all that are not at their
/// end yet. Particles that likely flow alike are packed together. What a particle gets depends on no other.
template <class Model>
class CapTile
{
 public:
  static constexpr std::size_t size = 256;

  explicit CapTile(CapIntegrator<Model>& one) : one_(one), lanes_(one.step()) {}

  /// Takes in the particles of a pack. Those that are not `sound` find no stress.
  void put(const Pack& pack, const CapParticleOf<Lanes>& particles, const CapStrainOf<Lanes>& strains,
           const Mask<Lanes>& sound)
  {
    old_.set(pack, particles);
    strain_.set(pack, strains);
    if (!all_of(sound)) tried_.set(pack, {particles, Lanes(std::numeric_limits<double>::infinity())});
    const auto way = whole_parts(lanes_.likely_way(particles));
    for (std::size_t l = 0; l < pack.n; ++l) {
      progress_[pack.of[l]] = {};
      waiting_[static_cast<std::size_t>(way[l])].add_if(sound[l], pack.of[l]);
    }
  }

  /// Brings all that were taken in to the end of their step.
  void advance()
  {
    for (List& list : waiting_) {
      while (!list.empty()) {
        list.for_each_pack([&](const Pack& pack) { substep(pack); });
        left_.for_each(
            [&](std::size_t i) { tried_.set(i, one_.substep(old_.at(i), strain_.at(i), progress_[i].size)); });
        left_.clear();
        list.keep_if([&](std::size_t i) { return !has_ended(i); });
      }
    }
  }

  /// The end of the step.
  CapOutcomeOf<Lanes> at(const Pack& pack) const { return tried_.at(pack); }

 private:
  using List = PackedList<size>;

  Lanes sizes(const Pack& pack) const
  {
    return each_lane([&](std::size_t l) { return progress_[pack.of[l]].size; });
  }

  void substep(const Pack& pack)
  {
    const auto tried = lanes_.substep(old_.at(pack), strain_.at(pack), sizes(pack));
    tried_.set(pack, tried.end);
    for (std::size_t l = 0; l < pack.n; ++l) {
      left_.add_if(tried.left[l], pack.of[l]);
      one_.counts().modulus_evaluations += tried.left[l] ? 0 : static_cast<std::size_t>(tried.n_evaluations[l]);
    }
  }

  bool has_ended(std::size_t i)
  {
    const Verdict verdict = one_.substeps().judge(progress_[i], tried_.last(i), one_.counts());
    if (verdict == Verdict::go_on) old_.set(i, tried_.at(i).now);
    return verdict == Verdict::end;
  }

  CapIntegrator<Model>& one_;
  CapLanes<Model> lanes_;
  Columns<CapParticleOf, size> old_;
  Columns<CapStrainOf, size> strain_;
  Columns<CapOutcomeOf, size> tried_;
  std::array<CapProgress, size> progress_;
  /// On their way, those that likely go the same one together.
  std::array<List, CapLanes<Model>::n_ways> waiting_;
  /// By CapLanes.
  List left_;
};

}  // namespace tamp::components
