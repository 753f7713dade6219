#pragma once

#include <memory>
#include <vector>

#include "runtime/execute/exchange.hpp"
#include "runtime/execute/halo.hpp"
#include "runtime/execute/migration.hpp"
#include "runtime/execute/work.hpp"
#include "runtime/graph/task_graph.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// A graph tied to its data: every argument of every instance is resolved once, so that running an instance looks
/// nothing up.
class BoundGraph final : public Work
{
 public:
  /// Collective. Throws GraphError unless the graph's layout is dealt to the ranks of the communicator. For `clocks`
  /// see Exchange.
  BoundGraph(const TaskGraph& graph, Warehouse& warehouse, const Communicator& communicator = {},
             const RankClocks* clocks = nullptr);

  const TaskGraph& graph() const { return graph_; }
  /// Null when the graph moves no particles.
  Migration* migration() { return migration_.get(); }
  /// Whether this rank runs an instance.
  bool is_local(int instance) const { return at(instance).rank == rank_; }
  /// Messages from other ranks so far.
  Traffic traffic() const { return exchange_ == nullptr ? Traffic{} : exchange_->traffic(); }
  /// See Exchange; empty on one rank.
  std::vector<std::uint64_t> message_ticks() const
  {
    return exchange_ == nullptr ? std::vector<std::uint64_t>{} : exchange_->message_ticks();
  }
  /// Times of a message that this rank received in the last step; for several ranks only.
  const MessageTimes& message_times(int message) const { return exchange_->times(message); }

  int n_instances() const override { return static_cast<int>(bound_.size()); }
  std::span<const int> predecessors(int instance) const override;
  int home(int instance, int n_workers) const override;
  /// Exceptions of task bodies pass through.
  void run(int instance, const Step& step) override;
  std::string describe(int instance) const override;
  bool has_messages() const override { return exchange_ != nullptr; }
  void poll(std::vector<int>& arrived, std::uint64_t idle_since) override { exchange_->poll(arrived, idle_since); }
  void fail(const std::string& what) override;

  /// Whether in the last step an instance found nothing to work on, see TaskBuilder::sparse.
  bool was_skipped(int instance) const { return bound_[static_cast<std::size_t>(instance)].was_skipped; }
  /// Bytes of the fields that an instance declares, as large as they are now; 0 if it was skipped.
  std::size_t bytes(int instance) const;
  /// Particles of the instance's patch and group that it declares to use; 0 for others.
  std::size_t n_particles(int instance) const;

 private:
  struct Taken {
    const Field* field;
    FieldBuffer buffer;
  };
  struct Bound {
    std::vector<Field*> fields;
    std::vector<BoundArgument> arguments;
    /// The halo of each label.
    std::vector<BoundHalo> halos;
    bool uses_particles = false;
    /// For each argument: whether this task is the first that adds to the patch's part.
    std::vector<bool> begins_part;
    /// When it may be skipped, by the numbers of its particles and by the fields that it takes.
    Sparsity sparsity = Sparsity::none;
    std::vector<const std::size_t*> counts;
    std::vector<Taken> taken;
    bool was_skipped = false;
  };

  const Instance& at(int instance) const { return graph_.instances()[static_cast<std::size_t>(instance)]; }
  const Patch& patch_of(const Instance& instance) const;
  Bound bind(const Instance& instance);
  Bound bind_body(const Instance& instance);
  Bound bind_halos(const Instance& instance);
  void bind_sparse(const Instance& instance, Bound& bound);
  void prepare(const Instance& instance, const Bound& bound);
  void send_particles(const Instance& instance);
  static bool makes_nothing(const Bound& bound);
  void make_nothing(const Instance& instance, const Bound& bound);
  Bound bind_reduction(const Label& label);
  static void combine(const Bound& bound);

  const TaskGraph& graph_;
  Warehouse& warehouse_;
  int rank_;
  /// For each patch, how many of this rank's patches come before it; and how many this rank has in all.
  std::vector<int> places_;
  int n_local_patches_ = 0;
  std::unique_ptr<Migration> migration_;
  /// Null where the migration waits for none.
  const Field* verdict_ = nullptr;
  std::unique_ptr<Exchange> exchange_;
  std::vector<Bound> bound_;
};

}  // namespace tamp::runtime
