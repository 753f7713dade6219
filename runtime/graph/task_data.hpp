#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "runtime/data/bound_argument.hpp"
#include "runtime/data/label.hpp"

namespace tamp::runtime
{

/// For each argument of a task its place among the accesses of the declaration, or none where it is not declared.
template <std::size_t N>
using ArgumentPlaces = std::array<int, N>;
inline constexpr int no_argument = -1;

/// The data of a task on one patch, as its body asks for them, by label:
///
///     [](const TaskContext& at, auto data) {
///       const auto old = data[temperature.previous()];
///       const auto now = data[temperature];
///     }
///
/// The answer is a span of particles, a GridView of nodes or cells, one of these for each group, or the value of a
/// reduction or a global; const where it is only read. A label that the task did not declare does not compile; one that
/// it declared on a condition which does not hold (Reference::when) is empty.
template <class... Arguments>
class TaskData
{
  template <class Asked>
  static constexpr std::size_t place = []() {
    constexpr std::array<bool, sizeof...(Arguments)> same{std::is_same_v<Asked, typename Arguments::Asked>...};
    std::size_t i = 0;
    while (i < same.size() && !same[i]) ++i;
    return i;
  }();
  template <class Asked>
  static constexpr bool is_declared = place<Asked> < sizeof...(Arguments);

 public:
  /// `bound`: the accesses of the declaration; both outlive this.
  TaskData(const BoundArgument* bound, const ArgumentPlaces<sizeof...(Arguments)>& places)
      : bound_(bound), places_(&places)
  {
  }

  template <class L, bool Previous>
  requires is_declared<Reference<L, Previous>>
  decltype(auto) operator[](const Reference<L, Previous>&) const
  {
    constexpr std::size_t i = place<Reference<L, Previous>>;
    const int at = (*places_)[i];
    return std::tuple_element_t<i, std::tuple<Arguments...>>::view(at == no_argument ? nullptr : bound_ + at);
  }
  template <class T, Centring C, LabelName Name>
  requires is_declared<Reference<NamedLabel<T, C, Name>>>
  decltype(auto) operator[](const NamedLabel<T, C, Name>& label) const { return (*this)[label.reference()]; }

 private:
  const BoundArgument* bound_;
  const ArgumentPlaces<sizeof...(Arguments)>* places_;
};

}  // namespace tamp::runtime
