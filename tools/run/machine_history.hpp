#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/csv_writer.hpp"

namespace tamp::tools
{

/// Use of the machine over simulated time, in `machine.csv`: wall-clock time, processor time and memory.
/// It stands apart from `history.csv`, which is the same bits in every run of a scene: this is never.
class MachineHistory
{
 public:
  /// Time counts from here on.
  explicit MachineHistory(runtime::Communicator communicator);

  /// Begins the table in a folder anew; the first rank writes it.
  void begin(const std::filesystem::path& folder);
  /// Goes on with it, and with the times in it, after the row of step `kept_until`.
  void resume(const std::filesystem::path& folder, long kept_until);
  /// A step has been run, which took so long.
  void add_step(double seconds);
  /// Takes in what all ranks have taken until now, at this step and simulated time [s]. Collective.
  void write_row(long step, double time, std::size_t ledger_bytes);
  /// Throws FileError if the table is no longer there as it was written. On the first rank.
  void expect_as_written() const { csv_->expect_as_written(); }

 private:
  using Clock = std::chrono::steady_clock;

  runtime::Communicator communicator_;
  Clock::time_point start_ = Clock::now();
  /// Processor time of this process at the start [s].
  double processor_at_start_;
  /// Time that the run took before its restart [s]; on the first rank.
  double wall_before_ = 0;
  double processor_before_ = 0;
  /// Time and number of steps since the row before.
  double step_seconds_ = 0;
  long n_steps_ = 0;
  /// On the first rank only.
  std::optional<runtime::CsvWriter> csv_;
  /// Number of columns of a table that goes on; 0 for one that was begun here.
  std::size_t n_columns_ = 0;
};

}  // namespace tamp::tools
