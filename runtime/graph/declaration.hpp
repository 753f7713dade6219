#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/data/bound_argument.hpp"
#include "runtime/data/label.hpp"
#include "runtime/graph/task_data.hpp"
#include "runtime/grid/patch_layout.hpp"

namespace tamp::runtime
{

/// How a task uses a label; there are no others than these five.
enum class Mode { read, compute, update, accumulate, reduce };

const char* to_string(Mode mode);

/// One label of one task, as the graph sees it.
struct Access {
  Mode mode;
  const Label* label;
  bool of_previous_step = false;
  int halo = 0;
  bool every_group = false;
  /// For accumulated labels: whether the sum starts at zero again, see Reference::anew.
  bool anew = false;
};

/// A step: its number, and its place in simulated time.
struct Step {
  long index = 0;
  /// Simulated time at the start of the step [s].
  double time = 0;
  /// Length of the step [s].
  double size = 0;
  /// Length of the step before [s]; 0 for the first.
  double previous_size = 0;
  /// Bits by which this rank's host may tell all others something: a task that reduces them makes it known.
  unsigned host_requests = 0;
  /// How long the step before took this rank by the clock [s], where a trace of the slowest step is wanted; else 0.
  float previous_wall = 0;
};

/// The first argument of every task body.
struct TaskContext {
  const PatchLayout& layout;
  /// The patch; in a task over ranks, one without cells whose id is -1.
  const Patch& patch;
  /// The group; -1 in a task that runs once a patch for all groups.
  int group;
  const Step& step;
};

/// The set that a task runs over, once for each item of it.
enum class Domain { patches_and_groups, patches, ranks, migration };

/// The patches on which a body makes nothing but zeros and neutral parts, and so need not run: none, as far as is
/// known; or those where, of the node and cell fields of this step that it reads or updates,
///  - all are zero, and there are no particles either;
///  - all are zero, whatever particles there are;
///  - those of all groups but one are zero.
enum class Sparsity { none, no_particles, no_fields, no_pair };

/// A task as declared: its name, its data, its body. The graph infers everything else from this.
struct TaskDeclaration {
  std::string name;
  /// The part of the step that it belongs to, for readers of a trace; may be empty.
  std::string phase;
  Domain domain = Domain::patches_and_groups;
  /// Groups it runs for; empty means all.
  std::vector<int> groups;
  std::vector<Access> accesses;
  Sparsity sparsity = Sparsity::none;
  std::function<void(const TaskContext&, const BoundArgument*)> body;

  bool uses(Mode mode, const Label& label) const
  {
    return std::any_of(accesses.begin(), accesses.end(),
                       [&](const Access& access) { return access.mode == mode && access.label == &label; });
  }
};

using TaskList = std::vector<TaskDeclaration>;

/// Builds a declaration; what has been declared is what the body can ask for, by label.
///
///     task("diffuse")
///         .over_patches_and_groups()
///         .reads(temperature.previous().halo(1))
///         .computes(temperature)
///         .body([](const TaskContext& at, auto data) {
///           const GridView<const double> old = data[temperature.previous()];
///           const GridView<double> now = data[temperature];
///           ...
///         });
///
/// Data that only some methods need are declared `label.when(condition)`, and empty in the body where they do not.
template <class... Arguments>
class TaskBuilder
{
  using Places = ArgumentPlaces<sizeof...(Arguments)>;

 public:
  explicit TaskBuilder(TaskDeclaration declaration, const Places& places = {})
      : declaration_(std::move(declaration)), places_(places)
  {
  }

  TaskBuilder over_patches() && { return std::move(*this).over(Domain::patches, {}); }
  TaskBuilder over_patches_and_groups(std::vector<int> groups = {}) &&
  {
    return std::move(*this).over(Domain::patches_and_groups, std::move(groups));
  }

  /// Once on every rank, with globals and whole reductions: what all ranks then know alike, none has to send.
  TaskBuilder over_ranks() && { return std::move(*this).over(Domain::ranks, {}); }

  /// Promises that the body makes only zeros and neutral parts, and leaves alone what it updates, on such patches: they
  /// are skipped.
  TaskBuilder sparse(Sparsity where = Sparsity::no_particles) &&
  {
    declaration_.sparsity = where;
    return std::move(*this);
  }

  /// Data of this step, or of the one before (`label.previous()`), that others wrote ("requires" in the field).
  template <class... L>
  auto reads(const L&... labels) &&
  {
    return std::move(*this).template with<Mode::read>(reference(labels)...);
  }
  /// Data that this task, and no other, makes.
  template <class... L>
  auto computes(const L&... labels) &&
  {
    return std::move(*this).template with<Mode::compute>(reference(labels)...);
  }
  /// Data changed in place, after the task that made it and in the order of declaration.
  template <class... L>
  auto updates(const L&... labels) &&
  {
    return std::move(*this).template with<Mode::update>(reference(labels)...);
  }
  /// Node or cell data to which every patch adds its part; it starts at zero, and readers get the sum of all parts, by
  /// the values' +=. Several tasks may, for the same groups; a patch's part is theirs in the order of declaration.
  /// With `label.anew()` a further sum begins, which is read by tasks that are declared after this one.
  template <class... L>
  auto accumulates(const L&... labels) &&
  {
    return std::move(*this).template with<Mode::accumulate>(reference(labels)...);
  }
  /// A part of one value over all patches and groups; it starts at the neutral value.
  template <class... L>
  auto reduces(const L&... labels) &&
  {
    return std::move(*this).template with<Mode::reduce>(reference(labels)...);
  }

  /// `function(const TaskContext&, TaskData)`; see TaskData for how it asks for its data.
  template <class Function>
  TaskDeclaration body(Function function) &&
  {
    declaration_.body = [f = std::move(function), places = places_](const TaskContext& context,
                                                                    const BoundArgument* bound) {
      f(context, TaskData<Arguments...>(bound, places));
    };
    return std::move(declaration_);
  }

 private:
  template <class... Other>
  friend class TaskBuilder;

  TaskBuilder over(Domain domain, std::vector<int> groups) &&
  {
    declaration_.domain = domain;
    declaration_.groups = std::move(groups);
    return std::move(*this);
  }

  template <class T, Centring C, LabelName Name>
  static auto reference(const NamedLabel<T, C, Name>& label)
  {
    return label.reference();
  }
  template <class L, bool Previous, bool EveryGroup>
  static auto reference(const Reference<L, Previous, EveryGroup>& r)
  {
    return r;
  }

  template <Mode M, class... L, bool... Previous, bool... EveryGroup>
  auto with(const Reference<L, Previous, EveryGroup>&... r) &&
  {
    static_assert(M != Mode::accumulate || (Addable<typename L::Value> && ...), "what is accumulated has a +=");
    constexpr std::size_t n_before = sizeof...(Arguments);
    ArgumentPlaces<n_before + sizeof...(L)> places;
    std::copy(places_.begin(), places_.end(), places.begin());
    std::size_t next = n_before;
    ((places[next++] = add({M, r.label, r.of_previous_step, r.halo_width, EveryGroup, r.is_anew}, r.is_declared)), ...);
    return TaskBuilder<Arguments..., Argument<L, Previous, EveryGroup, M == Mode::read>...>(std::move(declaration_),
                                                                                            places);
  }

  /// Its index among the accesses, or `no_argument` if it is not declared.
  int add(const Access& access, bool is_declared)
  {
    if (!is_declared && has_one_value(access.label->centring()) && access.mode != Mode::read) {
      throw std::logic_error("'" + declaration_.name + "' makes " + access.label->name() + " on a condition");
    }
    if (!is_declared) return no_argument;
    declaration_.accesses.push_back(access);
    return static_cast<int>(declaration_.accesses.size()) - 1;
  }

  TaskDeclaration declaration_;
  Places places_;
};

inline TaskBuilder<> task(std::string name)
{
  TaskDeclaration declaration;
  declaration.name = std::move(name);
  return TaskBuilder<>(std::move(declaration));
}

/// The runtime's own task that moves particles to the patch that `position` puts them in, at the end of a step.
/// `Point` is an array-like of coordinates [m], one for each dimension of the grid; what has left the grid along a
/// periodic axis is put back into it. `laps`, if given, counts for each axis how often that was done, upwards less
/// downwards: position + laps x length of the grid goes on where the position jumps.
template <class Point>
TaskDeclaration migration(const TypedLabel<Point, Centring::particle>& position,
                          const TypedLabel<Index, Centring::particle>* laps = nullptr)
{
  TaskDeclaration declaration;
  declaration.name = "migrate particles";
  declaration.domain = Domain::migration;
  declaration.accesses.push_back({Mode::update, &position});
  if (laps != nullptr) declaration.accesses.push_back({Mode::update, laps});
  return declaration;
}

/// A migration that waits for a reduction or a global: where a task before that throws, no particle has moved, and the
/// state before the step is still whole. Where that is the `step_verdict`, it moves none in a step that is refused.
template <class Point, class T, Centring C>
TaskDeclaration migration(const TypedLabel<Point, Centring::particle>& position, const TypedLabel<T, C>& last_check,
                          const TypedLabel<Index, Centring::particle>* laps = nullptr)
{
  static_assert(has_one_value(C));
  TaskDeclaration declaration = migration(position, laps);
  declaration.accesses.push_back({Mode::read, &last_check});
  return declaration;
}

inline const char* to_string(Mode mode)
{
  switch (mode) {
    case Mode::read:
      return "reads";
    case Mode::compute:
      return "computes";
    case Mode::update:
      return "updates";
    case Mode::accumulate:
      return "accumulates";
    case Mode::reduce:
      return "reduces";
  }
  return "";
}

}  // namespace tamp::runtime
