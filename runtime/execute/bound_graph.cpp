#include "runtime/execute/bound_graph.hpp"

#include <algorithm>
#include <bitset>
#include <cstring>

#include "runtime/graph/graph_error.hpp"
#include "runtime/graph/step_verdict.hpp"

namespace tamp::runtime
{

namespace
{

FieldBuffer buffer_of(const Access& access)
{
  if (access.of_previous_step) return FieldBuffer::previous;
  return access.mode == Mode::accumulate ? FieldBuffer::part : FieldBuffer::current;
}

std::span<Field* const> fields_of(const BoundArgument& argument)
{
  return {argument.fields, argument.n_fields};
}

}  // namespace

BoundGraph::BoundGraph(const TaskGraph& graph, Warehouse& warehouse, const Communicator& communicator,
                       const RankClocks* clocks)
    : graph_(graph), warehouse_(warehouse), rank_(communicator.rank())
{
  expect_ranks(graph.layout(), communicator.size());
  for (const Patch& patch : graph.layout()) {
    places_.push_back(n_local_patches_);
    if (patch.rank == rank_) ++n_local_patches_;
  }
  bound_.reserve(graph.instances().size());
  for (const Instance& instance : graph.instances()) {
    bound_.push_back(bind(instance));
    if (instance.kind == InstanceKind::send_particles && migration_ == nullptr) {
      const TaskDeclaration& migration = graph.declaration(instance);
      migration_ = std::make_unique<Migration>(warehouse, migration);
      if (migration.uses(Mode::read, step_verdict)) verdict_ = &warehouse.field(step_verdict, -1, -1);
    }
  }
  if (communicator.size() > 1) {
    exchange_ = std::make_unique<Exchange>(graph, warehouse, migration_.get(), communicator, clocks);
  }
}

BoundGraph::Bound BoundGraph::bind(const Instance& instance)
{
  if (instance.rank != rank_) return {};
  switch (instance.kind) {
    case InstanceKind::body:
      return bind_body(instance);
    case InstanceKind::sum_halo:
    case InstanceKind::fill_halo:
      return bind_halos(instance);
    case InstanceKind::combine:
      return bind_reduction(*instance.labels.front());
    default:
      return {};
  }
}

BoundGraph::Bound BoundGraph::bind_halos(const Instance& instance)
{
  const auto bind_halo = instance.kind == InstanceKind::sum_halo ? bind_halo_sum : bind_halo_fill;
  Bound bound;
  for (const Label* label : instance.labels) {
    bound.halos.push_back(bind_halo(warehouse_, *label, instance.patch, instance.group, instance.halo));
  }
  return bound;
}

BoundGraph::Bound BoundGraph::bind_body(const Instance& instance)
{
  Bound bound;
  const PatchLayout& layout = graph_.layout();
  const Patch& patch = patch_of(instance);
  const auto& accesses = graph_.declaration(instance).accesses;
  bound.fields.reserve(accesses.size() * static_cast<std::size_t>(graph_.n_groups() + 1));
  for (const Access& access : accesses) {
    BoundArgument argument;
    argument.buffer = buffer_of(access);
    argument.n_fields = access.every_group ? static_cast<std::size_t>(graph_.n_groups()) : 1;
    // The whole of a reduction, not this patch's part; or a global.
    const bool total = has_one_value(access.label->centring()) && access.mode != Mode::reduce;
    argument.fields = bound.fields.data() + bound.fields.size();
    for (int k = 0; k < static_cast<int>(argument.n_fields); ++k) {
      const int group = access.every_group ? k : total ? -1 : instance.group;
      bound.fields.push_back(&warehouse_.field(*access.label, total ? -1 : instance.patch, group));
    }
    const IndexBox own = access.label->centring() == Centring::node ? patch.nodes : patch.cells;
    argument.box = grown(own, access.halo, layout.grid().dimension);
    bound.uses_particles |= access.label->centring() == Centring::particle;
    bound.arguments.push_back(argument);
    const auto& begun = instance.begun;
    bound.begins_part.push_back(access.mode == Mode::accumulate &&
                                std::find(begun.begin(), begun.end(), access.label) != begun.end());
  }
  if (graph_.declaration(instance).sparsity != Sparsity::none) bind_sparse(instance, bound);
  return bound;
}

/// Lists what must be there for a sparse body to have anything to do.
void BoundGraph::bind_sparse(const Instance& instance, Bound& bound)
{
  // A layer that is filled from neighbours may not be zero.
  const auto is_filler = [&](int p) { return at(p).kind == InstanceKind::fill_halo; };
  if (std::any_of(instance.predecessors.begin(), instance.predecessors.end(), is_filler)) return;
  bound.sparsity = graph_.declaration(instance).sparsity;
  const auto& accesses = graph_.declaration(instance).accesses;
  for (std::size_t a = 0; a < accesses.size(); ++a) {
    const bool is_taken = accesses[a].mode == Mode::read || accesses[a].mode == Mode::update;
    const bool is_field = !has_one_value(accesses[a].label->centring());
    for (const Field* field : fields_of(bound.arguments[a])) {
      if (field->n_particles != nullptr) {
        bound.counts.push_back(field->n_particles);
      } else if (is_taken && is_field) {
        bound.taken.push_back({field, bound.arguments[a].buffer});
      }
    }
  }
  std::sort(bound.counts.begin(), bound.counts.end());
  bound.counts.erase(std::unique(bound.counts.begin(), bound.counts.end()), bound.counts.end());
}

/// The patch of an instance; one without cells in a task over ranks.
const Patch& BoundGraph::patch_of(const Instance& instance) const
{
  static const Patch none{-1, 0, {}, {}, {}, {}};
  return instance.patch < 0 ? none : graph_.layout()[instance.patch];
}

std::span<const int> BoundGraph::predecessors(int instance) const
{
  return at(instance).predecessors;
}

/// A patch stays with one worker, as its data stay in that core's cache.
int BoundGraph::home(int instance, int n_workers) const
{
  if (!is_local(instance)) return -1;
  const int patch = at(instance).patch;
  return patch < 0 ? 0 : places_[static_cast<std::size_t>(patch)] * n_workers / n_local_patches_;
}

std::string BoundGraph::describe(int i) const
{
  const Instance& instance = at(i);
  const std::string name = "'" + graph_.name(instance) + "'";
  if (instance.rank != rank_) return "message from rank " + std::to_string(instance.rank) + ", " + name;
  return instance.patch < 0 ? "task " + name : "task " + name + " on patch " + std::to_string(instance.patch);
}

void BoundGraph::fail(const std::string& what)
{
  if (exchange_ != nullptr) exchange_->fail(what);
}

void BoundGraph::run(int i, const Step& step)
{
  const Instance& instance = at(i);
  Bound& bound = bound_[static_cast<std::size_t>(i)];
  switch (instance.kind) {
    case InstanceKind::body: {
      bound.was_skipped = makes_nothing(bound);
      if (bound.was_skipped) return make_nothing(instance, bound);
      prepare(instance, bound);
      graph_.declaration(instance).body({graph_.layout(), patch_of(instance), instance.group, step},
                                        bound.arguments.data());
      break;
    }
    case InstanceKind::sum_halo:
      bound.was_skipped = true;
      for (const BoundHalo& halo : bound.halos) bound.was_skipped &= !sum_halo(halo);
      break;
    case InstanceKind::fill_halo:
      fill_halo(bound.halos.front(), instance.of_previous_step ? FieldBuffer::previous : FieldBuffer::current);
      break;
    case InstanceKind::combine:
      combine(bound);
      break;
    case InstanceKind::send_particles:
      send_particles(instance);
      break;
    case InstanceKind::receive_particles:
      migration_->receive(instance.patch, instance.group);
      break;
    case InstanceKind::send_message:
      exchange_->send(instance.message);
      break;
    case InstanceKind::receive_message:
      exchange_->receive(instance.message);
      break;
  }
}

/// A step that refuses itself moves no particle.
void BoundGraph::send_particles(const Instance& instance)
{
  const bool refused =
      verdict_ != nullptr && reinterpret_cast<const StepVerdict*>(verdict_->current_buffer.data())->refused;
  if (refused) {
    migration_->hold(instance.patch, instance.group);
  } else {
    migration_->send(instance.patch, instance.group);
  }
}

/// Prepares what a body may count on: parts start at zero, reductions at their neutral value. In the checked build what
/// is to be computed starts as not-a-number, so that a value left out shows.
void BoundGraph::prepare(const Instance& instance, const Bound& bound)
{
  const auto& accesses = graph_.declaration(instance).accesses;
  for (std::size_t a = 0; a < accesses.size(); ++a) {
    const Access& access = accesses[a];
    for (Field* field : fields_of(bound.arguments[a])) {
      if (access.mode == Mode::read) continue;
      if (bound.begins_part[a]) field->make_zero(FieldBuffer::part);
      std::byte* const values = field->written_values(bound.arguments[a].buffer);
      if (access.mode == Mode::reduce) access.label->reduction()->reset(values);
      if (checked_build && access.mode == Mode::compute && field->n_bytes() > 0) {
        std::memset(values, 0xff, field->n_bytes());
      }
    }
  }
}

/// Whether a body would find too little to make anything of it.
bool BoundGraph::makes_nothing(const Bound& bound)
{
  std::bitset<PerGroup<int>::max_groups> groups;
  bool any = false;
  for (const Taken& taken : bound.taken) {
    if (taken.field->is_zero(taken.buffer)) continue;
    any = true;
    if (taken.field->group >= 0) groups.set(static_cast<std::size_t>(taken.field->group));
  }
  switch (bound.sparsity) {
    case Sparsity::none:
      return false;
    case Sparsity::no_particles:
      return !any &&
             std::all_of(bound.counts.begin(), bound.counts.end(), [](const std::size_t* n) { return *n == 0; });
    case Sparsity::no_fields:
      return !any;
    case Sparsity::no_pair:
      return groups.count() < 2;
  }
  return false;
}

/// Leaves behind what a skipped body makes, which is there already if it was so in the step before.
void BoundGraph::make_nothing(const Instance& instance, const Bound& bound)
{
  const auto& accesses = graph_.declaration(instance).accesses;
  for (std::size_t a = 0; a < accesses.size(); ++a) {
    const Access& access = accesses[a];
    const bool stays = access.mode == Mode::read || access.mode == Mode::update;
    if (stays || access.label->centring() == Centring::particle) continue;
    for (Field* field : fields_of(bound.arguments[a])) {
      if (access.mode != Mode::accumulate || bound.begins_part[a]) field->make_zero(bound.arguments[a].buffer);
    }
  }
}

/// The whole value, and the parts by patch, then group, whichever rank's they are.
BoundGraph::Bound BoundGraph::bind_reduction(const Label& label)
{
  Bound bound;
  bound.fields.push_back(&warehouse_.field(label, -1, -1));
  for (const Patch& patch : graph_.layout()) {
    for (int g = -1; g < graph_.n_groups(); ++g) bound.fields.push_back(&warehouse_.field(label, patch.id, g));
  }
  return bound;
}

/// In the order of the parts, whatever the threads and ranks: the one place that decides it.
void BoundGraph::combine(const Bound& bound)
{
  Field& whole = *bound.fields.front();
  const ReductionOperations& reduction = *whole.label->reduction();
  reduction.reset(whole.current_buffer.data());
  for (std::size_t k = 1; k < bound.fields.size(); ++k) {
    if (bound.fields[k]->is_zero(FieldBuffer::current)) continue;
    reduction.combine(whole.current_buffer.data(), bound.fields[k]->current_buffer.data());
  }
}

std::size_t BoundGraph::bytes(int instance) const
{
  if (was_skipped(instance)) return 0;
  std::size_t sum = 0;
  for (const Field* f : bound_[static_cast<std::size_t>(instance)].fields) sum += f->n_bytes();
  return sum;
}

std::size_t BoundGraph::n_particles(int instance) const
{
  const Bound& bound = bound_[static_cast<std::size_t>(instance)];
  const Instance& self = at(instance);
  return bound.uses_particles && self.group >= 0 ? warehouse_.n_particles(self.patch, self.group) : 0;
}

}  // namespace tamp::runtime
