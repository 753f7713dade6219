#include "runtime/ranks/communicator.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
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

/// MPI counts in ints: what is longer travels in pieces.
constexpr std::size_t longest_piece = std::size_t{1} << 30;

/// Visits the first byte and the length of each piece.
template <class Visit>
void for_each_piece(std::size_t n, const Visit& visit)
{
  for (std::size_t first = 0; first < n; first += longest_piece) {
    visit(first, static_cast<int>(std::min(longest_piece, n - first)));
  }
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

/// A piece of each rank's bytes at a time, those of all together being of a length that MPI can count.
std::vector<std::vector<std::byte>> Communicator::gather(std::span<const std::byte> own) const
{
  if (handle_ == nullptr) return {{own.begin(), own.end()}};
  const std::vector<std::size_t> lengths = gather_value(own.size());
  const std::size_t longest = *std::max_element(lengths.begin(), lengths.end());
  const std::size_t piece = longest_piece / lengths.size();
  std::vector<std::vector<std::byte>> all(lengths.size());
  std::vector<std::byte> together;
  for (std::size_t first = 0; first < longest; first += piece) {
    std::vector<int> counts, starts{0};
    for (const std::size_t n : lengths) {
      counts.push_back(static_cast<int>(std::clamp(n, first, first + piece) - first));
      starts.push_back(starts.back() + counts.back());
    }
    together.resize(static_cast<std::size_t>(starts.back()));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgatherv(own.data() + std::min(first, own.size()), counts[static_cast<std::size_t>(rank_)], MPI_BYTE,
                    together.data(), counts.data(), starts.data(), MPI_BYTE, *handle_, &request);
    wait_for(request);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].insert(all[k].end(), together.begin() + starts[k], together.begin() + starts[k + 1]);
    }
  }
  return all;
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

void Communicator::receive(int rank, std::span<std::byte> bytes) const
{
  for_each_piece(bytes.size(), [&](std::size_t first, int n) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(bytes.data() + first, n, MPI_BYTE, rank, tag_of_bytes, *handle_, &request);
    wait_for(request);
  });
}

}  // namespace tamp::runtime
