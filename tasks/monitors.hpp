#pragma once

#include <cstdint>
#include <tuple>

#include "runtime/data/label.hpp"
#include "tasks/occurrences.hpp"
#include "tasks/step_totals.hpp"

/// What a run looks at, every so many steps, to say how far it can be trusted.
namespace tamp::tasks
{

/// A part of a whole, summed over particles and over the samples of a run.
struct Share {
  double part = 0;
  double whole = 0;

  double value() const { return whole > 0 ? part / whole : 0; }

  static constexpr auto fields = std::tuple{&Share::part, &Share::whole};
};

/// The pressure by which matter in compression is loaded, weighted by itself: what lies far from the load, and bears
/// next to nothing, does not count.
struct Load {
  double squared = 0;  ///< sum of V p^2 [Pa^2 m^3]
  double borne = 0;    ///< sum of V p [Pa m^3]

  double pressure() const { return borne > 0 ? squared / borne : 0; }

  static constexpr auto fields = std::tuple{&Load::squared, &Load::borne};
};

/// Sums over the particles of a state.
struct StateSample {
  /// Sums of V (p - p_c)^2 and V p^2, p_c being the mean pressure of a particle's material in its cell [Pa^2 m^3].
  Share uneven_pressure;
  /// Particles of elastic materials: those whose neighbours are more than 1.2 cells away, and that hold tension; all.
  Share torn_apart;
  /// Sums of V p over sand in compression: that which is looser than any test, and all [Pa m^3].
  Share borne_by_looser;
  Load load;
  /// Of those that are torn, looser than any test, and in compression beyond the largest strain that was tested, that
  /// with the lowest id.
  ParticlePlace torn, looser, out_of_range;

  static constexpr auto fields = std::tuple{&StateSample::uneven_pressure,
                                            &StateSample::torn_apart,
                                            &StateSample::borne_by_looser,
                                            &StateSample::load,
                                            runtime::Least{&StateSample::torn},
                                            runtime::Least{&StateSample::looser},
                                            runtime::Least{&StateSample::out_of_range}};
};

/// Matter has swollen if its volume is more than so many times that at its material's density. From its densest to its
/// loosest packing sand grows by about a third.
inline constexpr double swollen_from = 1.2;
/// It bears load if its pressure is above this part of the greatest load that the run has seen.
inline constexpr double bears_from = 0.01;

/// Masses of the deformable matter [kg]: that which has swollen and yet bears load, and all.
struct SwollenSample {
  Share bearing;
  /// Of the swollen particles that bear load that with the lowest id.
  ParticlePlace first;

  static constexpr auto fields = std::tuple{&SwollenSample::bearing, runtime::Least{&SwollenSample::first}};
};

/// Sums over the nodes at which two materials push each other.
struct ContactSample {
  /// Normal impulses [N s]: those across a gap, those between materials that are within each other, and all.
  Share early, within;
  /// Of each that at the node with the lowest number.
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
  /// Of the particles whose load crosses a gap that with the lowest id.
  ParticlePlace first;

  static constexpr auto fields = std::tuple{&WallSample::early, runtime::Least{&WallSample::first}};
};

/// A share in the samples of a run so far.
struct SampledShare {
  Share all;
  double greatest = 0;
  /// Of samples above the scene's limit.
  Occurrences above;

  void add(const Share& share, double limit, std::int64_t n_steps, double time, const ParticlePlace& place = {});
};

/// What a part of the matter bears at most in the samples of a run so far, over the most that all of it bears in any:
/// beside the blow that a run is about, what is left after it is nothing.
struct BorneShare {
  Share greatest;
  /// Of samples in which the part bears more than the scene's limit of the most so far.
  Occurrences above;

  void add(const Share& sample, double limit, std::int64_t n_steps, double time, const ParticlePlace& place);
};

/// The part of the materials' substeps that missed their tolerance, once there are many of them for each of
/// `n_particles`: in its first steps sand has no stress yet beside which an error could be small. Before that 0.
double missed_substeps(const components::UpdateCounts& updates, std::size_t n_particles);

/// The updates that ended in compression beyond the largest strains that their modulus was made for: not those of sand
/// that is looser than any test, nor those in tension, where sand has next to no stress, whatever its modulus.
std::size_t n_out_of_range(const components::UpdateCounts& updates);
/// The part of the updates that these are.
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

/// Kinetic energy of deformable particles in a step, and that of what no node sees of their motion,
/// v_p - sum S_ip v_i [J]; in steps that are sampled.
inline const runtime::ReductionLabel<Share, "motion in the null space"> null_space_motion;
inline const runtime::ReductionLabel<StateSample, "state sample"> state_sample;
inline const runtime::ReductionLabel<SwollenSample, "swollen sample"> swollen_sample;
inline const runtime::ReductionLabel<ContactSample, "contact sample"> contact_sample;
/// Only where walls have an image.
inline const runtime::ReductionLabel<WallSample, "wall sample"> wall_sample;
/// Since the start.
inline const runtime::GlobalLabel<MonitorRecords, "monitor records"> monitor_records;

}  // namespace tamp::tasks
