#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace tamp::runtime
{

/// MPI for as long as this object lives, if the program was started by a launcher such as mpirun; otherwise nothing:
/// one process alone needs no MPI. The thread level is MPI_THREAD_SERIALIZED: any worker may call, one at a time.
class MpiSession
{
 public:
  /// Throws std::runtime_error where the library cannot give that level.
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

/// Waits until a request is done. MPI's own waiting spins or yields; on cores that ranks share with each other or with
/// other programs, a rank that waits long is to sleep.
void wait_for(MPI_Request& request);

/// The ranks that work on one thing together. Without MPI, or by default, this process alone: rank 0 of 1.
///
/// The calls below are collective unless they say otherwise: all ranks make the same ones in the same order, from one
/// thread.
class Communicator
{
 public:
  Communicator() = default;
  /// All ranks of the program.
  static Communicator world();
  /// A communicator of the same ranks whose messages meet no others.
  Communicator duplicate() const;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }
  /// MPI_COMM_NULL for one process alone.
  MPI_Comm handle() const { return handle_ == nullptr ? MPI_COMM_NULL : *handle_; }

  void barrier() const;
  /// Gathers the bytes of each rank, by rank.
  std::vector<std::vector<std::byte>> gather(std::span<const std::byte> own) const;
  std::vector<std::string> gather(const std::string& own) const;
  /// Gathers one value from each rank, by rank.
  template <class T>
  std::vector<T> gather_value(const T& own) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> all(static_cast<std::size_t>(size_), own);
    gather_bytes(&own, all.data(), sizeof(T));
    return all;
  }
  /// Rank 0's value, on all.
  template <class T>
  T from_first(const T& own) const
  {
    return gather_value(own).front();
  }
  // Values of the ranks, combined on all of them. The order must not matter, so sums are of whole numbers.
  std::uint64_t sum(std::uint64_t own) const;
  /// Element by element.
  std::vector<std::uint64_t> sum(std::vector<std::uint64_t> own) const;
  std::uint64_t min(std::uint64_t own) const;
  std::uint64_t max(std::uint64_t own) const;
  double max(double own) const;
  /// Whether `own` is true on all ranks.
  bool all(bool own) const { return min(std::uint64_t{own}) == 1; }

  /// Bytes from this rank to another one, which takes as many with `receive`: not collective. Sends of one rank are
  /// received in their order.
  void send(int rank, std::span<const std::byte> bytes) const;
  void receive(int rank, std::span<std::byte> bytes) const;

 private:
  void gather_bytes(const void* own, void* all, std::size_t n) const;
  void reduce(void* values, std::size_t n, MPI_Datatype type, MPI_Op operation) const;

  int rank_ = 0;
  int size_ = 1;
  std::shared_ptr<MPI_Comm> handle_;
};

}  // namespace tamp::runtime
