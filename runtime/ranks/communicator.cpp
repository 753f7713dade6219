#include "runtime/ranks/communicator.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace tamp::runtime
{

namespace
{

/// Whether a launcher started this process: Open MPI's, or one that speaks PMI.
bool launched()
{
  constexpr std::array signs{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"};
  return std::any_of(signs.begin(), signs.end(), [](const char* name) { return std::getenv(name) != nullptr; });
}

bool running()
{
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  return begun != 0 && ended == 0;
}

/// Where pieces of these lengths begin when they stand in a row, and where the last one ends.
std::vector<int> starts(const std::vector<int>& lengths)
{
  std::vector<int> at(lengths.size() + 1, 0);
  std::partial_sum(lengths.begin(), lengths.end(), at.begin() + 1);
  return at;
}

std::vector<std::vector<std::byte>> cut(const std::vector<std::byte>& together, const std::vector<int>& starts)
{
  std::vector<std::vector<std::byte>> pieces;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    pieces.emplace_back(together.begin() + starts[k], together.begin() + starts[k + 1]);
  }
  return pieces;
}

/// MPI counts in ints: what is longer travels in pieces, of which this visits the first byte and the length of each.
template <class Visit>
void for_each_piece(std::size_t n, const Visit& visit)
{
  constexpr std::size_t longest = std::size_t{1} << 30;
  for (std::size_t first = 0; first < n; first += longest) visit(first, static_cast<int>(std::min(longest, n - first)));
}

constexpr int tag_of_bytes = 0;

}  // namespace

void wait_for(MPI_Request& request)
{
  constexpr int n_before_sleep = 100;
  int done = 0;
  for (int n = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0; ++n) {
    if (n >= n_before_sleep) std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

MpiSession::MpiSession(int& argc, char**& argv)
{
  if (!launched()) return;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) throw std::runtime_error("this MPI library does not let threads take turns");
}

MpiSession::~MpiSession()
{
  if (running()) MPI_Finalize();
}

Communicator Communicator::world()
{
  Communicator world;
  if (!running()) return world;
  MPI_Comm_size(MPI_COMM_WORLD, &world.size_);
  MPI_Comm_rank(MPI_COMM_WORLD, &world.rank_);
  world.handle_ = std::make_shared<MPI_Comm>(MPI_COMM_WORLD);
  return world;
}

Communicator Communicator::duplicate() const
{
  Communicator copy = *this;
  if (handle_ == nullptr) return copy;
  MPI_Comm fresh = MPI_COMM_NULL;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Comm_idup(*handle_, &fresh, &request);
  wait_for(request);
  copy.handle_ = std::shared_ptr<MPI_Comm>(new MPI_Comm(fresh), [](MPI_Comm* comm) {
    if (running()) MPI_Comm_free(comm);
    delete comm;
  });
  return copy;
}

void Communicator::barrier() const
{
  if (handle_ == nullptr) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(*handle_, &request);
  wait_for(request);
}

void Communicator::gather_bytes(const void* own, void* all, std::size_t n) const
{
  if (handle_ == nullptr) {
    std::memcpy(all, own, n);
  } else {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(own, static_cast<int>(n), MPI_BYTE, all, static_cast<int>(n), MPI_BYTE, *handle_, &request);
    wait_for(request);
  }
}

std::vector<std::vector<std::byte>> Communicator::gather(std::span<const std::byte> own) const
{
  const std::vector<int> counts = gather_value(static_cast<int>(own.size()));
  const std::vector<int> firsts = starts(counts);
  std::vector<std::byte> together(static_cast<std::size_t>(firsts.back()));
  if (handle_ == nullptr) {
    std::copy(own.begin(), own.end(), together.begin());
  } else {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgatherv(own.data(), counts[static_cast<std::size_t>(rank_)], MPI_BYTE, together.data(), counts.data(),
                    firsts.data(), MPI_BYTE, *handle_, &request);
    wait_for(request);
  }
  return cut(together, firsts);
}

std::vector<std::vector<std::byte>> Communicator::exchange(const std::vector<std::vector<std::byte>>& to_each) const
{
  if (handle_ == nullptr) return to_each;
  std::vector<int> given, taken(to_each.size());
  std::vector<std::byte> out;
  for (const auto& bytes : to_each) {
    given.push_back(static_cast<int>(bytes.size()));
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ialltoall(given.data(), 1, MPI_INT, taken.data(), 1, MPI_INT, *handle_, &request);
  wait_for(request);
  const std::vector<int> given_at = starts(given), taken_at = starts(taken);
  std::vector<std::byte> in(static_cast<std::size_t>(taken_at.back()));
  MPI_Ialltoallv(out.data(), given.data(), given_at.data(), MPI_BYTE, in.data(), taken.data(), taken_at.data(),
                 MPI_BYTE, *handle_, &request);
  wait_for(request);
  return cut(in, taken_at);
}

std::vector<std::string> Communicator::gather(const std::string& own) const
{
  std::vector<std::string> all;
  for (const auto& bytes : gather(std::as_bytes(std::span(own)))) {
    all.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return all;
}

void Communicator::reduce(void* values, std::size_t n, MPI_Datatype type, MPI_Op operation) const
{
  if (handle_ == nullptr) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, values, static_cast<int>(n), type, operation, *handle_, &request);
  wait_for(request);
}

std::uint64_t Communicator::sum(std::uint64_t own) const
{
  reduce(&own, 1, MPI_UINT64_T, MPI_SUM);
  return own;
}

std::vector<std::uint64_t> Communicator::sum(std::vector<std::uint64_t> own) const
{
  reduce(own.data(), own.size(), MPI_UINT64_T, MPI_SUM);
  return own;
}

std::uint64_t Communicator::min(std::uint64_t own) const
{
  reduce(&own, 1, MPI_UINT64_T, MPI_MIN);
  return own;
}

std::uint64_t Communicator::max(std::uint64_t own) const
{
  reduce(&own, 1, MPI_UINT64_T, MPI_MAX);
  return own;
}

double Communicator::max(double own) const
{
  reduce(&own, 1, MPI_DOUBLE, MPI_MAX);
  return own;
}

void Communicator::send(int rank, std::span<const std::byte> bytes) const
{
  for_each_piece(bytes.size(), [&](std::size_t first, int n) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(bytes.data() + first, n, MPI_BYTE, rank, tag_of_bytes, *handle_, &request);
    wait_for(request);
  });
}

std::vector<std::byte> Communicator::receive(int rank, std::size_t n) const
{
  std::vector<std::byte> bytes(n);
  for_each_piece(n, [&](std::size_t first, int of_piece) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(bytes.data() + first, of_piece, MPI_BYTE, rank, tag_of_bytes, *handle_, &request);
    wait_for(request);
  });
  return bytes;
}

}  // namespace tamp::runtime
