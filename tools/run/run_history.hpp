#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/storage/csv_writer.hpp"
#include "tasks/report/report.hpp"
#include "tasks/simulation.hpp"
#include "tools/run/extremes.hpp"

namespace tamp::tools
{

/// The energies of a simulation at one moment [J], counted since its start: kinetic and stored energy, heat, energy
/// that particles filter out of the motion of the nodes, and the work of gravity. `total` stays what it was at the
/// start but for the error of the steps.
struct EnergyBalance {
  double kinetic;
  double elastic;
  double plastic;
  double viscous;
  double contact;
  double filter;
  double half_step;
  double external;
  double total;
};

/// The largest work and momentum of a run so far, by which its errors are measured: they stay large when the run comes
/// to rest.
struct LargestSoFar {
  /// The work of gravity, loads and driving bodies, without its sign [J].
  double given_from_outside = 0;
  /// The sum of m |v|, with what gravity gives in a step [N s].
  double momenta = 0;
};

/// Shares of energy, momentum and mass that have come, gone or been taken without a cause in the mechanics.
struct BalanceShares {
  double energy_drift;     ///< over the energy that the run has been given
  double momentum_error;   ///< over the largest momentum
  double filtered_energy;  ///< by the transfer, over the energy given
  double damped_energy;    ///< by local damping, over the energy given, see `RunHistory::damped_energy`
  double lost_mass;        ///< mass that has left the grid, over all mass
};

/// Rows of the history in which such a share was above its limit.
struct BalanceSightings {
  tasks::Occurrences energy_drift, momentum_error, filtered_energy, damped_energy, lost_mass;
};

/// Follows a simulation from its start: energies, momentum, the motion of bodies, the peaks of materials.
class RunHistory
{
 public:
  /// To be made of a simulation at its start, even if that is restarted then. Here and below, calls are collective.
  explicit RunHistory(tasks::Simulation& simulation);
  RunHistory(const RunHistory&) = delete;
  RunHistory& operator=(const RunHistory&) = delete;

  /// Begins `history.csv` in a folder anew; the first rank writes it.
  void begin(const std::filesystem::path& folder);
  /// Goes on with it after the row of step `kept_until`: later ones are taken out. Returns, on the first rank, what the
  /// user should know about it; empty if it is as `expected`.
  std::string resume(const std::filesystem::path& folder, long kept_until, const runtime::CsvExtent& expected);
  /// Rows and bytes written so far; on the first rank.
  runtime::CsvExtent extent() const { return csv_ ? csv_->extent() : runtime::CsvExtent{}; }
  /// Takes in the state now.
  void measure();
  /// Takes in the state now, and writes it as a row.
  void write_row();

  /// To be asked after every step, which costs next to nothing: says so if the energy is wrong by more than `limit`
  /// times what the run has been given, see `energy_error`; empty otherwise. Where a centrifuge speeds up the balance
  /// is not known, and nothing is said.
  std::string energy_problem(double limit);
  /// Energy that has come or gone without a cause, or that particles have added where that is more, over what it is
  /// judged by, see `energy_scale`. Energy that particles filter out of the motion of the nodes is no error; energy
  /// that they add is. After the last step; it needs no `measure`.
  double energy_error() const;
  /// The energy given to the run so far [J], plus the work from outside, at its mean power so far, in the time in which
  /// waves cross the four cells over which a grid spreads an impact. Earlier it cannot be told what that work goes
  /// into, and a run from rest would be judged by next to nothing in its first steps.
  double energy_scale() const;
  /// The same; 0 where it is not known, as a centrifuge speeds up, and what is negligible beside the energy of waves.
  double known_energy_error() const;
  /// Energy given to the run so far: its initial energy and the largest work from outside [J].
  double given_energy() const;
  /// Change of momentum that the grid has not given to the particles, over the largest sum of m |v| so far.
  double momentum_error() const { return momentum_error_; }
  /// The shares as last measured.
  BalanceShares balances() const;
  const BalanceSightings& balances_above() const { return balances_above_; }
  void set_balances_above(const BalanceSightings& above) { balances_above_ = above; }
  /// A run that goes on has those of the run before.
  const LargestSoFar& largest() const { return largest_; }
  void set_largest(const LargestSoFar& largest) { largest_ = largest; }
  /// Extremes of the columns of the history, by name, over the rows so far, with those before a restart; on the first
  /// rank.
  const std::map<std::string, Extremes>& extremes() const { return extremes_; }
  const EnergyBalance& energies() const { return energies_; }
  const tasks::ParticleReport& report() const { return report_; }
  const tasks::NoseReport& nose_report() const { return nose_report_; }

  /// Throws FileError if `history.csv` is no longer there as it was written. On the first rank.
  void expect_as_written() const { csv_->expect_as_written(); }

  /// Bodies that move at the start, are rigid or under a pressure load; the others are what they move into.
  const std::vector<std::size_t>& tracked_bodies() const { return tracked_; }
  /// How far a body's centre of mass has moved along its initial velocity; of one that starts at rest, how far it is
  /// from where it started [m].
  double depth(std::size_t body) const;
  /// Contact force on a body's material, mean since the row before the last [N].
  const Eigen::Vector3d& contact_force(std::size_t body) const;
  /// For a body with a nose, the angle of its axis below the horizontal [degrees], the last axis of the scene being
  /// vertical; 90 points straight down.
  double axis_angle(std::size_t body) const;

 private:
  /// A column of `history.csv`: the name with the unit, and the value in the state that was last measured.
  struct Column {
    std::string name;
    std::function<double()> value;
  };

  /// Adds a column for each axis of the scene.
  template <class Value>
  void add_vector(const std::string& name, const std::string& unit, const Value& value);
  /// Takes in the extremes of rows that are there already.
  void take_extremes(const std::filesystem::path& file);
  void add_columns();
  void add_body_columns(std::size_t body);
  void add_error_columns(std::size_t body);
  void add_peak_columns(std::size_t material, const std::string& where, const tasks::PeaksOfMaterials& peaks);
  std::vector<std::string> column_names() const;
  /// Energy that is negligible in a balance [J]: that of all mass at a millionth of the fastest wave's speed, as matter
  /// at rest has no other energy to compare with; that of half a step of free fall; and the work of a step of driving
  /// and of loads, which is counted to the step's middle while the energy that it goes into is counted to the step's
  /// end.
  double negligible_energy() const;
  double wrong_energy() const;
  /// Energy that local damping took, as far as motion, plastic strain or friction stands beside it: these depend on
  /// what it took, while what has come to rest elastically is the same whichever way it came there [J].
  double damped_energy() const;
  void look_at_balances();
  bool knows_energy() const;
  /// Impulse of gravity and centrifuge on all mass in a step [N s]: sand at rest moves by no more than its round-off.
  double weight_of_a_step() const;

  tasks::Simulation& simulation_;
  std::vector<std::size_t> tracked_;
  tasks::ParticleReport initial_;
  /// Constants of the scene at its start.
  double mass_;              ///< kg
  double wave_speed_;        ///< of the fastest material [m/s]
  double acceleration_;      ///< the greatest by gravity and centrifuge [m/s^2]
  double time_over_cells_;   ///< in which the slowest waves cross four cells [s]
  double elastic_at_start_;  ///< J
  tasks::ParticleReport report_;
  tasks::NoseReport nose_report_;
  tasks::LostParticles lost_;
  EnergyBalance energies_{};
  LargestSoFar largest_;
  BalanceSightings balances_above_;
  double momentum_error_ = 0;
  /// Mean forces by material, since the row before.
  tasks::MeanForces mean_forces_;
  std::vector<Column> columns_;
  std::map<std::string, Extremes> extremes_;
  /// On the first rank only.
  std::optional<runtime::CsvWriter> csv_;
};

}  // namespace tamp::tools
