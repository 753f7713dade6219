#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "runtime/data/field.hpp"
#include "runtime/graph/declaration.hpp"
#include "runtime/graph/graph_error.hpp"

namespace tamp::runtime
{

/// The kind of a node of the compiled graph: a declared body, or work of the runtime's own that the declarations imply.
enum class InstanceKind {
  body,
  sum_halo,
  fill_halo,
  combine,
  send_particles,
  receive_particles,
  send_message,
  receive_message
};

/// One task on one patch for one group.
struct Instance {
  InstanceKind kind = InstanceKind::body;
  int declaration = 0;
  /// The patch; -1 for what belongs to a rank as a whole: a task over ranks, combining a reduction, sending or
  /// receiving a message.
  int patch = -1;
  int rank = 0;
  /// The group; -1 for all groups.
  int group = -1;
  /// For work of the runtime: the labels it handles, whether those of the step before, and how wide the halo is.
  std::vector<const Label*> labels;
  bool of_previous_step = false;
  int halo = 0;
  /// For a body: the labels that it is the first to add to on its patch.
  std::vector<const Label*> begun;
  /// For a sender or receiver, which of the graph's messages; -1 otherwise.
  int message = -1;
  /// Instances that must be done before this one, ascending.
  std::vector<int> predecessors;
};

/// Why one instance waits for another.
struct Edge {
  int from = 0;
  int to = 0;
  const Label* label = nullptr;
  int halo = 0;
  /// Grid values that pass along the edge; particle data are counted when they are stored, as 0 here.
  std::size_t bytes = 0;
  /// The message by which it crosses from rank to rank; -1 for none.
  int message = -1;
};

/// The part of a message that holds one label's data of one patch and group.
struct MessagePart {
  const Label* label = nullptr;
  int from_patch = 0;
  /// The patch that receives it; -1 for a reduction.
  int to_patch = 0;
  int group = 0;
  FieldBuffer buffer = FieldBuffer::current;
  /// The part of a node or cell field that is sent.
  IndexBox box;
  /// The shift between `from_patch` and its image that `to_patch` sees, where it sees one.
  Index shift{0, 0, 0};
};

/// The data that one rank sends to another in a step for one purpose, all together.
struct Message {
  /// sum_halo, fill_halo, combine, or receive_particles: the kind of the instances that wait for it.
  InstanceKind purpose;
  int from_rank = 0;
  int to_rank = 0;
  /// The instances that send and receive it.
  int send = 0;
  int receive = 0;
  std::vector<MessagePart> parts;
  /// For each part, the instance that waits for it.
  std::vector<int> consumers;
  /// Its length; 0 for particles, of which there may be any number.
  std::size_t bytes = 0;
};

/// How a label is used by the whole graph, for one group (-1: common to all groups).
struct LabelUse {
  const Label* label = nullptr;
  int group = -1;
  /// Read from the step before, or given by the host to be read so.
  bool state = false;
  /// Made anew by the step.
  bool computed = false;
  bool accumulated = false;
  /// Has halos filled from neighbours, of the values of this step.
  bool filled = false;
};

/// Data that the host sets and reads outside of the graph.
struct HostData {
  /// State that the host sets before the first step; reductions here are accumulated.
  std::vector<const Label*> state;
  /// Results that the host reads after a step.
  std::vector<const Label*> results;
};

/// The tasks of one step over all patches and groups, with the edges that their declarations imply. Instances stand
/// in a legal serial order; the graph is compiled once and executed every step.
class TaskGraph
{
 public:
  /// Throws GraphError with every mistake found.
  TaskGraph(std::vector<TaskDeclaration> declarations, const PatchLayout& layout, std::vector<std::string> group_names,
            const HostData& host);

  const PatchLayout& layout() const { return *layout_; }
  const std::vector<std::string>& group_names() const { return group_names_; }
  int n_groups() const { return static_cast<int>(group_names_.size()); }
  const std::vector<TaskDeclaration>& declarations() const { return declarations_; }
  const std::vector<Instance>& instances() const { return instances_; }
  /// Why instances wait for their predecessors, for those who look at the graph; a run does not need them.
  const std::vector<Edge>& edges() const { return edges_; }
  void drop_edges() { std::vector<Edge>().swap(edges_); }
  const std::vector<Message>& messages() const { return messages_; }
  const std::vector<LabelUse>& label_uses() const { return label_uses_; }
  /// The widest halo that any task asks for; node and cell fields are stored with it.
  int storage_halo() const { return storage_halo_; }

  /// "interpolate to grid", or "sum halo: interpolate to grid" for work of the runtime.
  std::string name(const Instance& instance) const;
  const TaskDeclaration& declaration(const Instance& instance) const
  {
    return declarations_[static_cast<std::size_t>(instance.declaration)];
  }

 private:
  std::string name_of_use(const Instance& instance) const;

  const PatchLayout* layout_;
  std::vector<std::string> group_names_;
  std::vector<TaskDeclaration> declarations_;
  std::vector<Instance> instances_;
  std::vector<Edge> edges_;
  std::vector<Message> messages_;
  std::vector<LabelUse> label_uses_;
  int storage_halo_ = 0;
};

/// The uses of all labels and groups, one for each, with the properties that any of the graphs gives it.
std::vector<LabelUse> label_uses(std::span<const TaskGraph* const> graphs);
/// The widest halo that any of the graphs stores.
int storage_halo(std::span<const TaskGraph* const> graphs);

}  // namespace tamp::runtime
