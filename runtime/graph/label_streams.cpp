#include "runtime/graph/label_streams.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "runtime/graph/near_name.hpp"

namespace tamp::runtime
{

namespace
{

using Kind = GraphProblem::Kind;

bool contains(const std::vector<const Label*>& labels, const Label* label)
{
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

bool accumulates(const Use& use)
{
  return use.access.mode == Mode::accumulate;
}

/// A part is summed as far as any task reaches.
void widen_halos(std::vector<Use>& producers)
{
  int widest = 0;
  for (const Use& use : producers) widest = std::max(widest, use.access.halo);
  for (Use& use : producers) {
    if (accumulates(use)) use.access.halo = widest;
  }
}

std::vector<int> all_groups(int n_groups)
{
  std::vector<int> all(static_cast<std::size_t>(n_groups));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Looks through the declarations and their streams, and writes down what does not fit.
class Inspector
{
 public:
  Inspector(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams, const PatchLayout& layout,
            const HostData& host, int n_groups)
      : declarations_(declarations), streams_(streams), layout_(layout), host_(host), n_groups_(n_groups)
  {
  }

  std::vector<GraphProblem> inspect()
  {
    for (const TaskDeclaration& declaration : declarations_) {
      for (const Access& access : declaration.accesses) inspect_declared(declaration, access);
    }
    for (const auto& [key, streams] : streams_) {
      for (const LabelStream& stream : streams) {
        inspect_producers(*key.first, stream);
        for (const Use& use : stream.readers) inspect_reader(use, stream);
        for (const Use& use : stream.updaters) inspect_source(use, stream);
        inspect_use(*key.first, stream, &stream == &streams.back());
      }
    }
    return std::move(problems_);
  }

 private:
  void report(Kind kind, const std::string& task, const Label& label, const std::string& explanation)
  {
    // A label of several groups is one mistake, not one a group.
    if (reported_.insert({static_cast<int>(kind), task, label.name()}).second) {
      problems_.push_back({kind, task, label.name(), explanation});
    }
  }
  const std::string& name(const Use& use) const
  {
    return declarations_[static_cast<std::size_t>(use.declaration)].name;
  }

  void inspect_declared(const TaskDeclaration& declaration, const Access& access)
  {
    const Label& label = *access.label;
    const Centring centring = label.centring();
    if (access.mode == Mode::accumulate && !is_on_grid(centring)) {
      report(Kind::bad_declaration, declaration.name, label, "only node and cell data can be accumulated");
    }
    if (access.mode == Mode::accumulate && declaration.domain != Domain::patches_and_groups) {
      report(Kind::bad_declaration, declaration.name, label, "only a task over patches and groups can accumulate");
    }
    if (access.anew && access.mode != Mode::accumulate) {
      report(Kind::bad_declaration, declaration.name, label, "only what is accumulated can begin anew");
    }
    if ((access.mode == Mode::reduce) != (centring == Centring::reduction) && access.mode != Mode::read) {
      report(Kind::bad_declaration, declaration.name, label, "a reduction label is reduced, and no other is");
    }
    if (declaration.domain == Domain::ranks && !has_one_value(centring)) {
      report(Kind::bad_declaration, declaration.name, label, "a task over ranks can use globals and reductions alone");
    }
    if (declaration.domain == Domain::ranks && access.mode == Mode::reduce) {
      report(Kind::bad_declaration, declaration.name, label, "only tasks over patches have parts to reduce");
    }
    if (centring == Centring::global && access.mode != Mode::read &&
        (access.mode != Mode::compute || declaration.domain != Domain::ranks)) {
      report(Kind::bad_declaration, declaration.name, label, "a global is computed by a task over ranks, and read");
    }
    if (access.every_group && declaration.domain != Domain::patches) {
      report(Kind::bad_declaration, declaration.name, label, "only a task over patches can use every group's data");
    }
    if (access.of_previous_step && access.mode != Mode::read) {
      report(Kind::bad_declaration, declaration.name, label, "data of the step before can only be read");
    }
    if (access.halo > 0 && !is_on_grid(centring)) {
      report(Kind::bad_declaration, declaration.name, label, "only node and cell data have a halo");
    }
    // Particles near one seam may reach nodes across the next: a part would be missed.
    const int narrowest = layout_.narrowest();
    const int needed = access.mode == Mode::accumulate ? 2 * access.halo + 1 : access.halo;
    if (access.halo > 0 && needed > narrowest) {
      report(Kind::halo_too_narrow, declaration.name, label,
             "a halo of " + std::to_string(access.halo) + " needs patches at least " + std::to_string(needed) +
                 " cells wide; the narrowest has " + std::to_string(narrowest));
    }
  }

  void inspect_producers(const Label& label, const LabelStream& stream)
  {
    for (std::size_t k = 1; k < stream.producers.size(); ++k) {
      if (label.centring() == Centring::reduction && apart(stream.producers, k)) continue;
      if (accumulates(stream.producers[0]) && accumulates(stream.producers[k])) continue;
      report(Kind::double_compute, name(stream.producers[k]), label,
             "already made by task '" + name(stream.producers[0]) + "'");
    }
  }

  /// Several tasks may reduce one label as long as each does it for groups of its own.
  bool apart(const std::vector<Use>& producers, std::size_t k) const
  {
    const auto groups = [&](const Use& use) {
      return groups_of(declarations_[static_cast<std::size_t>(use.declaration)], n_groups_);
    };
    const std::vector<int> own = groups(producers[k]);
    return std::none_of(producers.begin(), producers.begin() + static_cast<std::ptrdiff_t>(k), [&](const Use& other) {
      const std::vector<int> others = groups(other);
      return std::find_first_of(own.begin(), own.end(), others.begin(), others.end()) != own.end();
    });
  }

  void inspect_source(const Use& use, const LabelStream& stream)
  {
    const Label& label = *use.access.label;
    const Domain domain = declarations_[static_cast<std::size_t>(use.declaration)].domain;
    if (domain == Domain::ranks && !has_one_value(label.centring())) return;  // reported before
    const bool migrated = domain == Domain::migration;
    if (use.access.of_previous_step || (migrated && contains(host_.state, &label))) {
      if (!contains(host_.state, &label)) {
        report(Kind::missing_producer, name(use), label, "read from the step before, but not among the given state");
      }
    } else if (stream.producers.empty()) {
      report(Kind::missing_producer, name(use), label, supplier_hint(label));
    }
  }

  void inspect_reader(const Use& use, const LabelStream& stream)
  {
    inspect_source(use, stream);
    if (use.access.of_previous_step || stream.producers.empty()) return;
    const Use& source = *stream.version_before(use.declaration);
    const bool exchangeable = source.access.mode == Mode::compute;
    if (use.access.halo > source.access.halo && !exchangeable) {
      report(Kind::halo_too_narrow, name(use), *use.access.label,
             "reads a halo of " + std::to_string(use.access.halo) + ", but task '" + name(source) + "' supplies " +
                 std::to_string(source.access.halo));
    }
  }

  void inspect_use(const Label& label, const LabelStream& stream, bool is_last)
  {
    const bool is_taken = is_last && (contains(host_.results, &label) || contains(host_.state, &label));
    if (stream.producers.empty() || is_taken) return;
    if (stream.readers.empty()) {
      report(Kind::unused_result, name(stream.producers[0]), label, "made, but never read by a task or the host");
    }
  }

  std::string supplier_hint(const Label& label) const
  {
    if (contains(host_.state, &label)) {
      return "no task makes it in this step; the value of the step before is there: previous()?";
    }
    std::vector<std::string> made;
    for (const auto& [key, streams] : streams_) {
      if (!streams.front().producers.empty()) made.push_back(key.first->name());
    }
    const std::string near = near_name(label.name(), made);
    return "no task makes it in this step" + (near.empty() ? "" : "; did you mean '" + near + "'?");
  }

  const std::vector<TaskDeclaration>& declarations_;
  const LabelStreams& streams_;
  const PatchLayout& layout_;
  const HostData& host_;
  int n_groups_;
  std::vector<GraphProblem> problems_;
  std::set<std::tuple<int, std::string, std::string>> reported_;
};

}  // namespace

bool LabelStream::is_summed_after(int declaration) const
{
  return !producers.empty() && accumulates(producers.back()) && producers.back().declaration == declaration;
}

const Use* LabelStream::version_before(int declaration) const
{
  const Use* version = producers.empty() ? nullptr : &producers.back();
  for (const Use& updater : updaters) {
    if (updater.declaration < declaration) version = &updater;
  }
  return version;
}

const LabelStream& stream_at(const LabelStreams& streams, const Label* label, int group, int declaration)
{
  const auto& of_label = streams.at({label, group});
  const auto is_begun = [&](const LabelStream& stream) { return stream.begin <= declaration; };
  return *std::find_if(of_label.rbegin(), of_label.rend(), is_begun);
}

const LabelStream* stream_before(const LabelStreams& streams, const Label* label, int group, int declaration)
{
  const LabelStream& stream = stream_at(streams, label, group, declaration);
  return &stream == &streams.at({label, group}).front() ? nullptr : &stream - 1;
}

std::vector<int> groups_of(const TaskDeclaration& declaration, int n_groups)
{
  if (declaration.domain == Domain::patches || declaration.domain == Domain::ranks) return {-1};
  if (!declaration.groups.empty()) return declaration.groups;
  return all_groups(n_groups);
}

std::vector<int> groups_of(const Access& access, int group, int n_groups)
{
  if (has_one_value(access.label->centring())) return {-1};
  if (!access.every_group) return {group};
  return all_groups(n_groups);
}

LabelStreams collect_streams(const std::vector<TaskDeclaration>& declarations, int n_groups)
{
  LabelStreams streams;
  for (int d = 0; d < static_cast<int>(declarations.size()); ++d) {
    const TaskDeclaration& declaration = declarations[static_cast<std::size_t>(d)];
    for (const Access& access : declaration.accesses) {
      std::set<int> groups;
      for (const int task_group : groups_of(declaration, n_groups)) {
        for (const int group : groups_of(access, task_group, n_groups)) groups.insert(group);
      }
      for (const int group : groups) {
        auto& of_label = streams[{access.label, group}];
        if (of_label.empty()) of_label.emplace_back();
        if (access.anew && !of_label.back().producers.empty()) of_label.emplace_back().begin = d;
        LabelStream& stream = of_label.back();
        auto& uses = access.mode == Mode::read     ? stream.readers
                     : access.mode == Mode::update ? stream.updaters
                                                   : stream.producers;
        uses.push_back({d, access});
      }
    }
  }
  for (auto& [key, of_label] : streams) {
    for (LabelStream& stream : of_label) widen_halos(stream.producers);
  }
  return streams;
}

std::vector<GraphProblem> find_problems(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                                        const PatchLayout& layout, const HostData& host, int n_groups)
{
  return Inspector(declarations, streams, layout, host, n_groups).inspect();
}

}  // namespace tamp::runtime
