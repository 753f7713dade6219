#pragma once

#include <mpi.h>

#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/execute/migration.hpp"
#include "runtime/execute/rank_clocks.hpp"
#include "runtime/graph/task_graph.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Another rank has failed, and said why.
struct OtherRankFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Messages that this rank has received, and how long they took. Times in ticks of the first rank's clock.
struct Traffic {
  std::uint64_t n_messages = 0;
  std::uint64_t n_bytes = 0;
  /// Time from being sent to being seen, summed over messages.
  std::uint64_t under_way = 0;
  /// The part of that in which the worker that saw the message had nothing to run.
  std::uint64_t waited_for = 0;

  void add(const Traffic& other);
};

/// A message that was received: when it was posted, on the sender's clock, and when it was seen here [ticks].
struct MessageTimes {
  std::uint64_t posted = 0;
  std::uint64_t arrived = 0;
  std::uint64_t n_bytes = 0;
};

/// Sends and receives one rank's messages of one graph.
///
/// All data for one rank and purpose travel in one message, into a buffer that is always open: a receive is posted
/// again as soon as its message has been unpacked, so a rank may run ahead of another by part of a step. Fixed lengths
/// use persistent requests; particles, whose number varies, are probed for. MPI is entered by one thread at a time.
class Exchange
{
 public:
  /// Collective over the communicator. `migration` may be null where the graph moves no particles, and `clocks` where
  /// those of all ranks are the same; they must outlive it.
  Exchange(const TaskGraph& graph, Warehouse& warehouse, Migration* migration, const Communicator& communicator,
           const RankClocks* clocks);
  ~Exchange();
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// Packs a message and sends it off.
  void send(int message);
  /// Unpacks a message that has arrived and opens its buffer to the next.
  void receive(int message);
  /// See Work::poll. Throws OtherRankFailed.
  void poll(std::vector<int>& arrived, std::uint64_t idle_since);
  /// Tells all other ranks.
  void fail(const std::string& what);

  const Traffic& traffic() const { return traffic_; }
  /// Ticks from being sent to being seen, summed, for each message of the graph; 0 for those to other ranks.
  const std::vector<std::uint64_t>& message_ticks() const { return message_ticks_; }
  /// Times of a message in the last step in which this rank received it.
  const MessageTimes& times(int message) const { return lines_[static_cast<std::size_t>(message)].unpacked; }

 private:
  struct Line {
    const Message* message = nullptr;
    /// The field of each part.
    std::vector<Field*> fields;
    /// When it was sent [ticks], then the data.
    std::vector<std::byte> bytes;
    LedgerHold held;
    /// The request of what is sent.
    MPI_Request request = MPI_REQUEST_NULL;
    /// For incoming messages of fixed length, the index of their request in `requests_`.
    std::size_t incoming_request = 0;
    /// Particles only: whether the next is looked for.
    bool open = false;
    /// Times of the message that came in last, which may be of the next step already, and of the one that was unpacked
    /// in this step.
    MessageTimes arrived;
    MessageTimes unpacked;
  };

  void open_line(Line& line, int message);
  void pack(Line& line);
  void unpack(const Line& line);
  void probe(int message, std::vector<int>& arrived, std::uint64_t idle_since);
  void take(int message, std::vector<int>& arrived, std::uint64_t idle_since);
  std::uint64_t first_rank(int rank, std::uint64_t ticks) const;
  void take_failure();

  const TaskGraph& graph_;
  Warehouse& warehouse_;
  Migration* migration_;
  Communicator communicator_;
  const RankClocks* clocks_;
  /// The MPI datatype in which lengths are counted.
  MPI_Datatype unit_;
  std::mutex mutex_;
  /// State by message; empty for messages of other ranks.
  std::vector<Line> lines_;
  /// Receives of fixed length as MPI tests them, the last one for failures, and the message of each.
  std::vector<MPI_Request> requests_;
  std::vector<int> message_of_request_;
  std::vector<int> completed_;
  std::vector<int> particle_messages_;
  std::vector<char> failure_text_;
  bool failed_ = false;
  Traffic traffic_;
  std::vector<std::uint64_t> message_ticks_;
};

}  // namespace tamp::runtime
