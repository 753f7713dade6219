#include <algorithm>
#include <utility>
#include <vector>

#include "tools/bench/tasks_ranks_contestants.hpp"

namespace tamp::tools::bench
{

namespace
{

/// This rank's patches with one more on each side for what the neighbours send; numbered from 0 for the first of those.
class HandWrittenHalo : public RowScheduler
{
 public:
  HandWrittenHalo(StampedRow& row, const runtime::Communicator& ranks)
      : row_(row),
        ranks_(ranks.duplicate()),
        last_(row.shape().patches_per_rank),
        n_values_(static_cast<std::size_t>(row.shape().n_values)),
        old_(static_cast<std::size_t>(last_ + 2) * n_values_),
        now_(old_.size())
  {
    for (int p = 1; p <= last_; ++p) std::ranges::fill(values(old_, p), row_.stamp(0, patch_at(p)));
  }

  void run(int n_steps) override
  {
    for (int n = 0; n < n_steps; ++n) {
      start_messages();
      for (int p = 2; p < last_; ++p) run_patch(p);
      if (n_requests_ > 0) MPI_Waitall(n_requests_, requests_, MPI_STATUSES_IGNORE);
      run_patch(1);
      if (last_ > 1) run_patch(last_);
      std::swap(old_, now_);
      ++step_;
    }
  }

 private:
  using Values = std::vector<std::uint64_t>;

  int patch_at(int p) const { return row_.shape().first_of(ranks_.rank()) + p - 1; }
  std::span<std::uint64_t> values(Values& all, int p) const
  {
    return std::span(all).subspan(static_cast<std::size_t>(p) * n_values_, n_values_);
  }

  void start_messages()
  {
    n_requests_ = 0;
    if (ranks_.rank() > 0) swap_with(ranks_.rank() - 1, 1, 0);
    if (ranks_.rank() + 1 < ranks_.size()) swap_with(ranks_.rank() + 1, last_, last_ + 1);
  }
  void swap_with(int rank, int give, int take)
  {
    const int n = static_cast<int>(n_values_);
    MPI_Irecv(values(old_, take).data(), n, MPI_UINT64_T, rank, 0, ranks_.handle(), &requests_[n_requests_++]);
    MPI_Isend(values(old_, give).data(), n, MPI_UINT64_T, rank, 0, ranks_.handle(), &requests_[n_requests_++]);
  }
  void run_patch(int p)
  {
    row_.run(step_, patch_at(p), values(old_, p - 1), values(old_, p), values(old_, p + 1), values(now_, p));
  }

  StampedRow& row_;
  runtime::Communicator ranks_;
  int last_;
  std::size_t n_values_;
  Values old_, now_;
  MPI_Request requests_[4]{};
  int n_requests_ = 0;
  long step_ = 0;
};

}  // namespace

RowContestant plain_mpi_row_contestant()
{
  return {"plain MPI", [](StampedRow& row, const runtime::Communicator& ranks) -> std::unique_ptr<RowScheduler> {
            return std::make_unique<HandWrittenHalo>(row, ranks);
          }};
}

}  // namespace tamp::tools::bench
