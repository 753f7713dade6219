#pragma once

#include <cstddef>
#include <map>
#include <stdexcept>
#include <vector>

#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Particles on their way to another patch, each with the bytes of all its state fields.
struct ParticleParcel {
  std::size_t n_particles = 0;
  std::size_t n_bytes = 0;
  Buffer buffer;

  void add(const std::byte* bytes, std::size_t n);
  void clear() { n_particles = n_bytes = 0; }
};

/// Moves particles to the patch whose cells they are in. Stayers keep their order; arrivals are appended in the order
/// of the patch they come from, so that the result is the same whatever the threads. What has left the grid along a
/// periodic axis is first put back into it, by the axis's length.
class Migration
{
 public:
  /// `declaration` updates the label by whose coordinates (doubles, one for each dimension of the grid) particles are
  /// placed, and the one that counts their laps if there is one.
  Migration(Warehouse& warehouse, const TaskDeclaration& declaration);

  /// Packs the particles of a patch and group that have left it and closes the gaps. Those outside of the grid are
  /// gone.
  void send(int patch, int group);
  /// Leaves them where they are: nothing is packed.
  void hold(int patch, int group);
  /// Takes in what the neighbours packed for this patch.
  void receive(int patch, int group);

  /// Particles that one patch has packed for another, as bytes at the end of a message; and back from there into this
  /// rank's copy of the other patch's outbox. `read_parcel` returns where the next parcel begins.
  void write_parcel(const MessagePart& part, std::vector<std::byte>& message) const;
  const std::byte* read_parcel(const MessagePart& part, const std::byte* from);

 private:
  struct Outbox {
    std::map<int, ParticleParcel*> to_patch;
    /// Whether particles left in the last step.
    bool used = false;
  };

  bool stays(const IndexBox& cells, const std::byte* position) const;
  int destination(std::byte* position, Index& laps) const;
  double put_back(std::size_t axis, std::byte* coordinate, Index& laps) const;
  void pack(ParticleParcel& parcel, std::size_t particle, const std::vector<Field*>& fields) const;
  std::size_t place(int patch, int group) const
  {
    return static_cast<std::size_t>(patch * warehouse_.n_groups() + group);
  }
  Outbox& box(int patch, int group) { return outboxes_[place(patch, group)]; }
  const Outbox& box(int patch, int group) const { return outboxes_[place(patch, group)]; }

  Warehouse& warehouse_;
  const Label& position_;
  const Label* laps_;
  std::vector<Outbox> outboxes_;
  /// Arrivals at each patch and group from each of its neighbours, together in memory: most often there are none.
  std::vector<std::vector<ParticleParcel>> arrivals_;
  /// The state of the particles of each patch and group.
  std::vector<std::vector<Field*>> fields_;
};

}  // namespace tamp::runtime
