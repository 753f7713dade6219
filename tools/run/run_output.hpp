#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "runtime/storage/background_writer.hpp"
#include "runtime/storage/fields/field_file.hpp"
#include "tasks/simulation.hpp"

namespace tamp::tools
{

/// Time that a run spent on output [s]: making it, or writing it where that is not done in the background, and
/// waiting for the writer in the background.
struct OutputTime {
  double history = 0;
  double fields = 0;
  double checkpoints = 0;
  double waited = 0;
};

/// Writes the fields and checkpoints of a run, in the order of the calls.
///
/// In the background they are copied, and the copies brought to the first rank, where a thread of its own writes them
/// while the run goes on. There is at most one copy at a time, of fields or state: a run that wants to make the next
/// before the last has been written waits. Otherwise all ranks write together and the run waits.
///
/// All calls but `has_failed` are collective, and what fails on one rank throws on all: FileError for files. What fails
/// in the background throws in the next call.
class RunOutput
{
 public:
  struct Options {
    std::filesystem::path folder;
    bool in_background = true;
    /// How many checkpoints are kept.
    int keep = 2;
    /// Throws if nothing may be written into the folder any more; called by the first rank, in any thread.
    std::function<void()> expect_own;
  };

  /// The simulation runs on the executor.
  RunOutput(tasks::Simulation& simulation, runtime::Executor& executor, Options options);

  /// Begins the field file anew, or goes on with it, see runtime::FieldFile::continued; returns what the user should
  /// know, on the first rank.
  void begin();
  std::string resume(long last_step, std::size_t n_expected);
  /// Outputs in the field file when it was begun or gone on with; on the first rank.
  std::size_t n_fields_at_start() const { return n_fields_at_start_; }

  void write_fields(bool with_nodes);
  void write_checkpoint(const std::string& fingerprint, std::span<const std::byte> host);
  /// Throws FileError if `fields.h5` is no longer there as it was written. When all is; on the first rank.
  void expect_as_written() const { fields_->expect_as_written(); }
  /// Waits until all is written.
  void finish();
  /// Finishes the output of a run that has failed already, without throwing.
  void settle();
  /// Whether something could not be written in the background; on the first rank.
  bool has_failed() const { return writer_ != nullptr && writer_->has_failed(); }
  bool in_background() const { return options_.in_background; }
  /// All but the history's; on the first rank.
  OutputTime time() const;

 private:
  template <class Work>
  void on_first_rank(const Work& work) const;
  /// Does what makes or writes something, and adds to its time.
  template <class Work>
  void timed(double& seconds, const Work& work);
  void wait();
  void leave(std::function<void()> job);

  tasks::Simulation& simulation_;
  runtime::Executor& executor_;
  Options options_;
  /// The file of all ranks, or, in the background, of the first alone.
  std::optional<runtime::FieldFile> fields_;
  std::size_t n_fields_at_start_ = 0;
  OutputTime time_;
  /// On the first rank, in the background; last, as its jobs use what is above.
  std::unique_ptr<runtime::BackgroundWriter> writer_;
};

}  // namespace tamp::tools
