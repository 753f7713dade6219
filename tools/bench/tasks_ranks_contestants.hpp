#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "tools/bench/tasks_ranks_row.hpp"

namespace tamp::tools::bench
{

/// Something that runs the tasks of a row of patches, step after step, on one thread of each rank.
class RowScheduler
{
 public:
  virtual ~RowScheduler() = default;
  /// Runs so many steps more. Collective, but ranks may leave at different times.
  virtual void run(int n_steps) = 0;
};

/// A contestant of the comparison. Making and destroying its scheduler are collective.
struct RowContestant {
  std::string name;
  std::unique_ptr<RowScheduler> (*make)(StampedRow& row, const runtime::Communicator& ranks);
};

/// A task declared with a halo of the step before, its compiled graph, and the executor, as a simulation has them.
RowContestant tamp_row_contestant();
/// The exchange written by hand: MPI_Irecv and MPI_Isend, the patches within, MPI_Waitall, the patches at the ends. The
/// floor, as nothing is looked up and nothing decided at run time.
RowContestant plain_mpi_row_contestant();

}  // namespace tamp::tools::bench
