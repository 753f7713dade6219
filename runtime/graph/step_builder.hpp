#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// The compiled declarations of a step, not yet in any order. Edges within a rank join instances directly; data for
/// another rank go by a message, whose sender and receiver are instances too.
struct CompiledStep {
  std::vector<Instance> instances;
  std::vector<Edge> edges;
  std::vector<Message> messages;
};

/// Data of another patch that an instance waits for.
struct Transfer {
  /// Makes the data; -1 for what is there when the step begins.
  int producer;
  int consumer;
  MessagePart part;
  int halo;
  std::size_t bytes;
  /// The declaration that makes this version of the data, which distinguishes messages; -1 for the step before.
  int maker;
};

/// Collects the instances of a step and what they wait for, and makes messages of what crosses from rank to rank.
class StepBuilder
{
 public:
  explicit StepBuilder(const PatchLayout& layout) : layout_(layout) {}

  const PatchLayout& layout() const { return layout_; }
  Instance& instance(int i) { return step_.instances[static_cast<std::size_t>(i)]; }

  /// Both give the number of the new instance: one on a patch, for one group or -1; one of a whole rank.
  int add_on_patch(InstanceKind kind, int declaration, int patch, int group);
  int add_on_rank(InstanceKind kind, int declaration, int rank);

  void edge(int from, int to, const Label* label, int halo, std::size_t bytes, int message = -1);
  /// An edge from producer to consumer where both are on one rank, else a part of a message.
  void transfer(const Transfer& transfer);
  /// The instance that copies the data of a transfer: its consumer, or the sender of its message.
  int copier(const Transfer& transfer);
  /// The instance at which the data arrive: its consumer, or the receiver of its message.
  int receiver(const Transfer& transfer);

  /// A patch's own nodes or cells, whichever the label is on, with a halo; and the bytes of a label in a box.
  IndexBox box_of(const Label& label, int patch, int halo) const;
  static std::size_t bytes_of(const Label& label, const IndexBox& box);
  /// Which nodes or cells of an image, with a halo of its own, lie in the box of a patch: in the image's own indices.
  IndexBox shared_box(const Label& label, const IndexBox& box, const PatchImage& image, int image_halo) const;

  CompiledStep finish();

 private:
  /// Purpose, label (where a message has one only), maker, from rank, to rank.
  using MessageKey = std::tuple<InstanceKind, const Label*, int, int, int>;

  int add(Instance fresh);
  bool crosses(const Transfer& transfer);
  int message_for(const Transfer& transfer);
  void measure(Message& message);

  const PatchLayout& layout_;
  CompiledStep step_;
  std::map<MessageKey, int> messages_;
};

}  // namespace tamp::runtime
