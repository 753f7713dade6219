#include "runtime/execute/exchange.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/execute/clock.hpp"
#include "runtime/execute/halo.hpp"

namespace tamp::runtime
{

namespace
{

constexpr std::size_t header_bytes = sizeof(std::uint64_t);
/// MPI counts in ints. Lengths are rounded up to so many bytes, and these counted: up to 128 GiB.
constexpr std::size_t unit_bytes = 64;
constexpr std::size_t longest_failure = 1000;

MPI_Datatype unit()
{
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(unit_bytes, MPI_BYTE, &type);
  MPI_Type_commit(&type);
  return type;
}

int in_units(std::size_t n_bytes)
{
  return static_cast<int>(n_bytes / unit_bytes);
}

std::size_t whole_units(std::size_t n_bytes)
{
  return (n_bytes + unit_bytes - 1) / unit_bytes * unit_bytes;
}

bool of_particles(const Message& message)
{
  return message.purpose == InstanceKind::receive_particles;
}

}  // namespace

void Traffic::add(const Traffic& other)
{
  n_messages += other.n_messages;
  n_bytes += other.n_bytes;
  under_way += other.under_way;
  waited_for += other.waited_for;
}

Exchange::Exchange(const TaskGraph& graph, Warehouse& warehouse, Migration* migration, const Communicator& communicator,
                   const RankClocks* clocks)
    : graph_(graph),
      warehouse_(warehouse),
      migration_(migration),
      communicator_(communicator.duplicate()),
      clocks_(clocks),
      unit_(unit()),
      lines_(graph.messages().size()),
      failure_text_(longest_failure, '\0'),
      message_ticks_(lines_.size(), 0)
{
  for (std::size_t m = 0; m < lines_.size(); ++m) open_line(lines_[m], static_cast<int>(m));
  const int failure_tag = static_cast<int>(lines_.size());
  MPI_Recv_init(failure_text_.data(), longest_failure, MPI_CHAR, MPI_ANY_SOURCE, failure_tag, communicator_.handle(),
                &requests_.emplace_back());
  message_of_request_.push_back(-1);
  completed_.resize(requests_.size());
  MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
}

/// Tags are the numbers of the messages, which are the same on all ranks.
void Exchange::open_line(Line& line, int message)
{
  const Message& m = graph_.messages()[static_cast<std::size_t>(message)];
  const bool incoming = m.to_rank == communicator_.rank();
  if (!incoming && m.from_rank != communicator_.rank()) return;
  line.message = &m;
  line.held = LedgerHold(warehouse_.ledger().messages, 0);
  for (const MessagePart& part : m.parts) {
    line.fields.push_back(&warehouse_.field(*part.label, part.from_patch, part.group));
  }
  if (of_particles(m)) {
    line.open = incoming;
    if (incoming) particle_messages_.push_back(message);
    return;
  }
  // Before each part, whether all of it is zero and left out.
  line.bytes.resize(whole_units(header_bytes + m.parts.size() + m.bytes));
  line.held.hold(line.bytes.capacity());
  const int n = in_units(line.bytes.size());
  if (incoming) {
    line.incoming_request = requests_.size();
    MPI_Recv_init(line.bytes.data(), n, unit_, m.from_rank, message, communicator_.handle(), &requests_.emplace_back());
    message_of_request_.push_back(message);
  } else {
    MPI_Send_init(line.bytes.data(), n, unit_, m.to_rank, message, communicator_.handle(), &line.request);
  }
}

Exchange::~Exchange()
{
  for (MPI_Request& request : requests_) {
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    MPI_Request_free(&request);
  }
  for (Line& line : lines_) {
    if (line.request == MPI_REQUEST_NULL) continue;
    // After a failure nobody may be there to take the message.
    if (!failed_) wait_for(line.request);
    if (line.request != MPI_REQUEST_NULL) MPI_Request_free(&line.request);
  }
  MPI_Type_free(&unit_);
}

void Exchange::send(int message)
{
  Line& line = lines_[static_cast<std::size_t>(message)];
  {
    // The message of the step before. Its receiver may be a step behind, but waits for nothing that this rank has not
    // sent.
    const std::lock_guard lock(mutex_);
    wait_for(line.request);
  }
  pack(line);
  const std::uint64_t now = ticks();
  std::memcpy(line.bytes.data(), &now, header_bytes);
  const std::lock_guard lock(mutex_);
  if (of_particles(*line.message)) {
    MPI_Isend(line.bytes.data(), in_units(line.bytes.size()), unit_, line.message->to_rank, message,
              communicator_.handle(), &line.request);
  } else {
    MPI_Start(&line.request);
  }
}

void Exchange::receive(int message)
{
  Line& line = lines_[static_cast<std::size_t>(message)];
  unpack(line);
  line.unpacked = line.arrived;
  const std::lock_guard lock(mutex_);
  if (of_particles(*line.message)) {
    line.open = true;
  } else {
    MPI_Start(&requests_[line.incoming_request]);
  }
}

void Exchange::pack(Line& line)
{
  const Message& m = *line.message;
  if (of_particles(m)) {
    line.bytes.resize(header_bytes);
    for (const MessagePart& part : m.parts) migration_->write_parcel(part, line.bytes);
    line.bytes.resize(whole_units(line.bytes.size()));
    line.held.hold(line.bytes.capacity());
    return;
  }
  std::byte* at = line.bytes.data() + header_bytes;
  for (std::size_t k = 0; k < m.parts.size(); ++k) {
    const bool is_zero = line.fields[k]->is_zero(m.parts[k].buffer);
    *at++ = std::byte{is_zero};
    if (!is_zero) at = copy_out(*line.fields[k], m.parts[k].buffer, m.parts[k].box, at);
  }
}

void Exchange::unpack(const Line& line)
{
  const Message& m = *line.message;
  const std::byte* at = line.bytes.data() + header_bytes;
  if (of_particles(m)) {
    for (const MessagePart& part : m.parts) at = migration_->read_parcel(part, at);
    return;
  }
  for (std::size_t k = 0; k < m.parts.size(); ++k) {
    Field& field = *line.fields[k];
    const FieldBuffer buffer = m.parts[k].buffer;
    if (*at++ != std::byte{0}) {
      field.make_zero(buffer);
    } else {
      at = copy_in(field, buffer, m.parts[k].box, at);
    }
  }
}

void Exchange::poll(std::vector<int>& arrived, std::uint64_t idle_since)
{
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  int n = 0;
  MPI_Testsome(static_cast<int>(requests_.size()), requests_.data(), &n, completed_.data(), MPI_STATUSES_IGNORE);
  for (int k = 0; k < n; ++k) {
    const int message = message_of_request_[static_cast<std::size_t>(completed_[static_cast<std::size_t>(k)])];
    if (message < 0) take_failure();
    take(message, arrived, idle_since);
  }
  for (const int message : particle_messages_) {
    if (lines_[static_cast<std::size_t>(message)].open) probe(message, arrived, idle_since);
  }
}

void Exchange::probe(int message, std::vector<int>& arrived, std::uint64_t idle_since)
{
  Line& line = lines_[static_cast<std::size_t>(message)];
  int there = 0;
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(line.message->from_rank, message, communicator_.handle(), &there, &handle, &status);
  if (there == 0) return;
  int n = 0;
  MPI_Get_count(&status, unit_, &n);
  line.bytes.resize(static_cast<std::size_t>(n) * unit_bytes);
  line.held.hold(line.bytes.capacity());
  MPI_Mrecv(line.bytes.data(), n, unit_, &handle, MPI_STATUS_IGNORE);
  line.open = false;
  take(message, arrived, idle_since);
}

void Exchange::take(int message, std::vector<int>& arrived, std::uint64_t idle_since)
{
  Line& line = lines_[static_cast<std::size_t>(message)];
  arrived.push_back(line.message->send);
  std::uint64_t sent = 0;
  std::memcpy(&sent, line.bytes.data(), header_bytes);
  const std::uint64_t now = ticks();
  line.arrived = {sent, now, line.bytes.size()};
  ++traffic_.n_messages;
  traffic_.n_bytes += line.bytes.size();
  const std::uint64_t posted = first_rank(line.message->from_rank, sent);
  const std::uint64_t seen = first_rank(communicator_.rank(), now);
  if (seen <= posted) return;
  traffic_.under_way += seen - posted;
  message_ticks_[static_cast<std::size_t>(message)] += seen - posted;
  if (idle_since == 0) return;
  const std::uint64_t waiting_since = std::max(posted, first_rank(communicator_.rank(), idle_since));
  if (seen > waiting_since) traffic_.waited_for += seen - waiting_since;
}

std::uint64_t Exchange::first_rank(int rank, std::uint64_t ticks) const
{
  return clocks_ == nullptr ? ticks : clocks_->first_rank(rank, ticks);
}

void Exchange::fail(const std::string& what)
{
  std::vector<char> text(longest_failure, '\0');
  std::copy_n(what.begin(), std::min(what.size(), longest_failure - 1), text.begin());
  const int tag = static_cast<int>(lines_.size());
  const std::lock_guard lock(mutex_);
  failed_ = true;
  for (int rank = 0; rank < communicator_.size(); ++rank) {
    // Short enough to be taken in by MPI at once, whatever the other rank is at.
    if (rank != communicator_.rank()) {
      MPI_Send(text.data(), longest_failure, MPI_CHAR, rank, tag, communicator_.handle());
    }
  }
}

void Exchange::take_failure()
{
  failed_ = true;
  throw OtherRankFailed(failure_text_.data());
}

}  // namespace tamp::runtime
