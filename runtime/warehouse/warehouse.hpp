#pragma once

#include <deque>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/data/field.hpp"
#include "runtime/data/memory_ledger.hpp"
#include "runtime/data/views.hpp"
#include "runtime/graph/task_graph.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// All field data of one rank's patches, and what messages bring of other ranks' patches: the state at the end of the
/// last step and what the current step makes.
///
/// Between steps the host reads and sets the state; during a step only tasks see data, through their arguments.
class Warehouse
{
 public:
  /// Makes storage for every label that `graphs` use. The first graph is the step that computes the state; others may
  /// read the state and make results of their own. Particle fields grow with `set_n_particles`; node and cell fields
  /// that are no state are stored on demand: from when a task first writes to them until they have been zero for a
  /// while. On most patches of a sparse scene they never are.
  explicit Warehouse(std::span<const TaskGraph* const> graphs, int rank = 0);
  Warehouse(const Warehouse&) = delete;
  Warehouse& operator=(const Warehouse&) = delete;

  /// The same graphs over patches dealt anew. What a patch holds goes straight into its fields on the other rank, one
  /// field at a time, and patches that stay are not touched. Throws GraphError where they are dealt to other ranks than
  /// the communicator's. Collective.
  void deal(std::span<const TaskGraph* const> graphs, const Communicator& communicator);

  const PatchLayout& layout() const { return *layout_; }
  int n_groups() const { return n_groups_; }
  bool is_local(const Patch& patch) const { return patch.rank == rank_; }
  MemoryLedger& ledger() { return ledger_; }
  const MemoryLedger& ledger() const { return ledger_; }
  /// Particles on this rank's patches; 0 for others.
  std::size_t n_particles(int patch, int group) const { return count(patch, group); }
  std::size_t n_particles(int group) const;
  /// Grows or cuts every particle field of a patch and group; new values are zero bytes, or what cut particles left.
  void set_n_particles(int patch, int group, std::size_t n);

  /// The state of a label at the end of the last step.
  template <class T>
  std::span<T> state(const TypedLabel<T, Centring::particle>& label, int patch, int group)
  {
    Field& f = field(label, patch, group);
    return {reinterpret_cast<T*>(f.previous_buffer.data()), *f.n_particles};
  }
  template <class T, Centring C>
  GridView<T> grid_state(const TypedLabel<T, C>& label, int patch, int group)
  {
    static_assert(C == Centring::node || C == Centring::cell);
    Field& f = field(label, patch, group);
    return {reinterpret_cast<T*>(f.previous_buffer.data()), f.box, f.box.strides()};
  }
  template <class T>
  T& global_state(const TypedLabel<T, Centring::global>& label)
  {
    return *reinterpret_cast<T*>(field(label, -1, -1).previous_buffer.data());
  }
  template <class T>
  const T& global_state(const TypedLabel<T, Centring::global>& label) const
  {
    return *reinterpret_cast<const T*>(field(label, -1, -1).previous_buffer.data());
  }
  /// A node or cell field that is no state, as the last step left it.
  template <class T, Centring C>
  GridView<const T> grid_result(const TypedLabel<T, C>& label, int patch, int group)
  {
    Field& f = field(label, patch, group);
    return {reinterpret_cast<const T*>(f.values(FieldBuffer::current)), f.box, f.box.strides()};
  }
  template <class T, Centring C>
  const T& result(const TypedLabel<T, C>& label)
  {
    static_assert(has_one_value(C));
    return *reinterpret_cast<const T*>(field(label, -1, -1).current_buffer.data());
  }

  /// An accumulated reduction since the start, or since it was last taken.
  template <class T>
  T& total(const TypedLabel<T, Centring::reduction>& label)
  {
    return *reinterpret_cast<T*>(field(label, -1, -1).previous_buffer.data());
  }
  /// Returns an accumulated reduction and begins it anew. To be called by all ranks alike.
  template <class T>
  T take(const TypedLabel<T, Centring::reduction>& label)
  {
    return std::exchange(total(label), T{});
  }

  /// Makes what the step computed the state for the next.
  void advance();

  std::deque<Field>& fields() { return fields_; }
  /// The field itself, for the executor. Throws std::out_of_range for a label that no graph uses.
  Field& field(const Label& label, int patch, int group);
  const Field& field(const Label& label, int patch, int group) const
  {
    return const_cast<Warehouse*>(this)->field(label, patch, group);
  }
  /// All particle fields of a patch and group; those that are state come with their particles when they migrate.
  const std::vector<Field*>& particle_fields(int patch, int group) const;
  const std::size_t& count(int patch, int group) const;

 private:
  void add_field(const LabelUse& use, int patch, int halo);
  void store_on_demand(Field& field);
  void reserve(Field& field) const;
  std::size_t place(int patch, int group) const
  {
    return static_cast<std::size_t>((patch + 1) * (n_groups_ + 1) + group + 1);
  }
  void release(int patch);
  void send(int patch, int rank, const Communicator& communicator);
  void receive(int patch, int rank, const Communicator& communicator);
  void reserve_copies(const TaskGraph& graph);

  const PatchLayout* layout_;
  int rank_;
  int n_groups_;
  MemoryLedger ledger_;
  std::deque<Field> fields_;
  /// State that a step makes anew from that of the last step; and fields that are stored on demand.
  std::vector<Field*> changing_;
  std::vector<Field*> on_demand_;
  /// Zero bytes, as many as the largest of the fields on demand has.
  Buffer zeros_;
  long n_advances_ = 0;
  /// By label, then patch and group, each from -1.
  std::unordered_map<const Label*, std::vector<Field*>> lookup_;
  std::vector<std::size_t> counts_;
  std::vector<std::vector<Field*>> particle_fields_;
  /// All fields of each patch, but those of the rank as a whole.
  std::vector<std::vector<Field*>> fields_of_patch_;
};

}  // namespace tamp::runtime
