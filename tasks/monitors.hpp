#pragma once

#include <cstdint>
#include <tuple>

#include "runtime/data/label.hpp"
#include "tasks/occurrences.hpp"
#include "tasks/step_totals.hpp"

/// Samples that a run takes every so many steps, to say how far it can be trusted.
namespace tamp::tasks
{

/// A part of a whole, summed over particles and over the samples of a run.
struct Share {
  double part = 0;
  double whole = 0;

  double value() const { return whole > 0 ? part / whole : 0; }

  static constexpr auto fields = std::tuple{&Share::part, &Share::whole};
};

/// Pressure of the matter in compression, weighted by itself: matter far from the load, which bears next to nothing,
/// does not count.
struct Load {
  double squared = 0;  ///< sum of V p^2 [Pa^2 m^3]
  double borne = 0;    ///< sum of V p [Pa m^3]

  double pressure() const { return borne > 0 ? squared / borne : 0; }

  static constexpr auto fields = std::tuple{&Load::squared, &Load::borne};
};

/// Sums over the particles of a state.
struct StateSample {
  /// Sums of V (p - p_c)^2 and V p^2 [Pa^2 m^3], p_c being the mean pressure of a particle's material in its cell.
  Share uneven_pressure;
  /// Numbers of particles of elastic materials: of those whose neighbours are more than 1.2 cells away and that hold
  /// tension, and of all.
  Share torn_apart;
  /// Sums of V p over sand in compression [Pa m^3]: over the sand that is looser than any test, and over all.
  Share borne_by_looser;
  Load load;
  /// The particle with the lowest id among those that are torn, that are looser than any test, and that are in
  /// compression beyond the largest strain that was tested.
  ParticlePlace torn, looser, out_of_range;

  static constexpr auto fields = std::tuple{&StateSample::uneven_pressure,
                                            &StateSample::torn_apart,
                                            &StateSample::borne_by_looser,
                                            &StateSample::load,
                                            runtime::Least{&StateSample::torn},
                                            runtime::Least{&StateSample::looser},
                                            runtime::Least{&StateSample::out_of_range}};
};

/// Matter counts as swollen if its volume exceeds that at its material's density by this factor. From its densest to
/// its loosest packing sand grows by about a third.
inline constexpr double swollen_from = 1.2;
/// Matter bears load if its pressure is above this part of the greatest load that the run has seen.
inline constexpr double bears_from = 0.01;

/// Masses of the deformable matter [kg]: of the part that has swollen and yet bears load, and of all.
struct SwollenSample {
  Share bearing;
  /// The particle with the lowest id among the swollen ones that bear load.
  ParticlePlace first;

  static constexpr auto fields = std::tuple{&SwollenSample::bearing, runtime::Least{&SwollenSample::first}};
};

/// Sums over the nodes at which two materials push each other.
struct ContactSample {
  /// Normal impulses [N s]: those across a gap, those between materials that are within each other, and all.
  Share early, within;
  /// The node with the lowest number that has an impulse of each kind.
  ParticlePlace first_early, first_within;

  /// An impulse across a gap [cells], below 0 where the materials are within each other.
  void add(double gap, double impulse, const ParticlePlace& place);

  static constexpr auto fields =
      std::tuple{&ContactSample::early, &ContactSample::within, runtime::Least{&ContactSample::first_early},
                 runtime::Least{&ContactSample::first_within}};
};

/// Loads on walls with an image behind them [J], see components::WallLoads: those across a gap, and all.
struct WallSample {
  Share early;
  /// The particle with the lowest id among those whose load crosses a gap.
  ParticlePlace first;

  static constexpr auto fields = std::tuple{&WallSample::early, runtime::Least{&WallSample::first}};
};

/// A share in the samples of a run so far.
struct SampledShare {
  Share all;
  double greatest = 0;
  /// The samples above the scene's limit.
  Occurrences above;

  void add(const Share& share, double limit, std::int64_t n_steps, double time, const ParticlePlace& place = {});
};

/// Largest load that a part of the matter bears in the samples of a run so far, over the largest that all of it bears
/// in any sample: after the main impact of a run, what is still borne is small beside it.
struct BorneShare {
  Share greatest;
  /// The samples in which the part bears more than the scene's limit, as a share of the most borne so far.
  Occurrences above;

  void add(const Share& sample, double limit, std::int64_t n_steps, double time, const ParticlePlace& place);
};

/// The part of the materials' substeps that missed their tolerance, once there are many of them for each of
/// `n_particles`: in its first steps sand has no stress yet beside which an error could be small. Before that 0.
double missed_substeps(const components::UpdateCounts& updates, std::size_t n_particles);

/// The updates that ended in compression beyond the largest strains that their modulus was made for: not those of sand
/// that is looser than any test, nor those in tension, where sand has next to no stress, whatever its modulus.
std::size_t n_out_of_range(const components::UpdateCounts& updates);
/// The share of these among all updates.
double out_of_range(const components::UpdateCounts& updates);

struct MonitorRecords {
  SampledShare null_space, uneven_pressure, torn_apart, early_contact, interpenetration;
  SampledShare early_at_walls;
  SampledShare swollen_load;
  BorneShare looser_than_tested;
  double greatest_load = 0;  ///< Load::pressure [Pa]
  /// Samples in which the share since the start was above its limit.
  Occurrences missed_substeps, out_of_range;
};

/// Kinetic energy of deformable particles in a step, and of the part of their motion that no node sees, v_p - sum S_ip
/// v_i [J]; in steps that are sampled.
inline const runtime::ReductionLabel<Share, "motion in the null space"> null_space_motion;
inline const runtime::ReductionLabel<StateSample, "state sample"> state_sample;
inline const runtime::ReductionLabel<SwollenSample, "swollen sample"> swollen_sample;
inline const runtime::ReductionLabel<ContactSample, "contact sample"> contact_sample;
/// Only where walls have an image.
inline const runtime::ReductionLabel<WallSample, "wall sample"> wall_sample;
/// Records of the samples since the start.
inline const runtime::GlobalLabel<MonitorRecords, "monitor records"> monitor_records;

}  // namespace tamp::tasks
