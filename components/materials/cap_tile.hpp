#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "components/materials/cap_integrator.hpp"
#include "components/materials/cap_lanes.hpp"
#include "components/moduli/modulus.hpp"
#include "components/packs.hpp"

namespace tamp::components
{

/// The steps of up to `size` particles of sand, side by side: each round tries one substep of all that are not at their
/// end yet. Particles that likely flow alike are packed together. The result of a particle depends on no other.
template <class Model>
class CapTile
{
 public:
  static constexpr std::size_t size = 256;

  explicit CapTile(CapIntegrator<Model>& one) : one_(one), lanes_(one.step()) {}

  /// Takes in n particles from number `first` on. Those that are not `sound` find no stress.
  void put(std::size_t first, std::size_t n, const CapParticleOf<Lanes>& particles, const CapStrainOf<Lanes>& strains,
           const Mask<Lanes>& sound)
  {
    old_.set_lanes(first, particles);
    strain_.set_lanes(first, strains);
    if (!all_of(sound)) tried_.set_lanes(first, {particles, Lanes(std::numeric_limits<double>::infinity())});
    const auto way = whole_parts(lanes_.likely_way(particles));
    for (std::size_t l = 0; l < n; ++l) starting_[static_cast<std::size_t>(way[l])].add_if(sound[l], first + l);
  }

  /// Brings all that were taken in to the end of their step.
  void advance();

  /// The end of the step of particles from number `first` on.
  CapOutcomeOf<Lanes> lanes_at(std::size_t first) const { return tried_.lanes_at(first); }

 private:
  using List = PackedList<size>;
  using Some = Mask<Lanes>;

  Lanes sizes(const Pack& pack) const
  {
    return each_lane([&](std::size_t l) { return progress_[pack.of[l]].size; });
  }

  /// The step as one: what most particles take.
  void try_whole(const Pack& pack)
  {
    const Some ended = substep(pack, 1.0) <= one_.substeps().tolerance(), counted = first_lanes(pack.n);
    one_.counts().substeps += count(ended && counted);
    if (all_of(ended)) return;
    for (std::size_t l = 0; l < pack.n; ++l) {
      progress_[pack.of[l]] = {};
      under_way_.add_if(!ended[l], pack.of[l]);
    }
  }

  /// Answers with the errors; infinite where a particle is left.
  Lanes substep(const Pack& pack, const Lanes& part)
  {
    const auto tried = lanes_.substep(old_.at(pack), strain_.at(pack), part);
    tried_.set(pack, tried.end);
    add_where(first_lanes(pack.n) && !tried.left, tried.n_evaluations, n_evaluations_);
    if (none_of(tried.left)) return tried.end.error;
    for (std::size_t l = 0; l < pack.n; ++l) left_.add_if(tried.left[l], pack.of[l]);
    return select(tried.left, Lanes(std::numeric_limits<double>::infinity()), tried.end.error);
  }

  /// Does what CapLanes left, and keeps those that are not at their end.
  void judge_under_way()
  {
    left_.for_each([&](std::size_t i) { tried_.set(i, one_.substep(old_.at(i), strain_.at(i), progress_[i].size)); });
    left_.clear();
    under_way_.keep_if([&](std::size_t i) { return !has_ended(i); });
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
  /// Particles that have yet to start, by the way that they likely go.
  std::array<List, CapLanes<Model>::n_ways> starting_;
  List under_way_;
  /// Particles that CapLanes has left to CapIntegrator.
  List left_;
  Lanes n_evaluations_ = 0.0;  ///< by CapLanes, of the elastic model
};

template <class Model>
void CapTile<Model>::advance()
{
  for (List& list : starting_) {
    list.for_each_pack([&](const Pack& pack) { try_whole(pack); });
    list.clear();
    judge_under_way();
    while (!under_way_.empty()) {
      under_way_.for_each_pack([&](const Pack& pack) { substep(pack, sizes(pack)); });
      judge_under_way();
    }
  }
  one_.counts().modulus_evaluations += static_cast<std::size_t>(reduce(std::exchange(n_evaluations_, 0.0)));
}

// Each takes the compiler ten seconds: they are made in cap_tile_*.cpp. Those of other models are made where they are
// used.
extern template class CapTile<UnloadingTable>;
extern template class CapTile<ModulusSurface>;
extern template class CapTile<SupportVectorModulus>;
extern template class CapTile<EngineeringStrain<SupportVectorModulus>>;
extern template class CapTile<NetworkModulus>;
extern template class CapTile<EngineeringStrain<NetworkModulus>>;

}  // namespace tamp::components
