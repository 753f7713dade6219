#pragma once

#include <map>
#include <utility>
#include <vector>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// One access of one declaration.
struct Use {
  int declaration;
  Access access;
};

/// The life of one label for one group (-1: common) within a step: who makes it, who changes it, who reads it. Where it
/// begins anew (Reference::anew), that is the life of another stream.
struct LabelStream {
  /// Number of the declaration that it begins with; 0 for the first stream of its label.
  int begin = 0;
  /// Tasks that compute, accumulate or reduce it, in the order of declaration. In a sound graph one computes it, or
  /// several accumulate it, all with the widest halo of theirs.
  std::vector<Use> producers;
  /// Tasks that update it, and tasks that read it, in the order of declaration.
  std::vector<Use> updaters;
  std::vector<Use> readers;

  /// Whether `declaration` is the last of those that accumulate it: then there is the sum.
  bool is_summed_after(int declaration) const;
  /// The last task that changed the label before `declaration`, or the one after which it is made.
  const Use* version_before(int declaration) const;
};

using StreamKey = std::pair<const Label*, int>;
/// The streams of each label and group, in their order in the step; at least one for each.
using LabelStreams = std::map<StreamKey, std::vector<LabelStream>>;

/// The stream of a label for a group that a declaration uses.
const LabelStream& stream_at(const LabelStreams& streams, const Label* label, int group, int declaration);
/// The stream before that one; null for the first.
const LabelStream* stream_before(const LabelStreams& streams, const Label* label, int group, int declaration);

/// Groups that a declaration runs for: -1 alone when it runs once a patch or a rank.
std::vector<int> groups_of(const TaskDeclaration& declaration, int n_groups);
/// Groups whose field an access names when its task runs for `group`.
std::vector<int> groups_of(const Access& access, int group, int n_groups);

LabelStreams collect_streams(const std::vector<TaskDeclaration>& declarations, int n_groups);

/// Every mistake but a cycle, which only the instances show.
std::vector<GraphProblem> find_problems(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                                        const PatchLayout& layout, const HostData& host, int n_groups);

}  // namespace tamp::runtime
