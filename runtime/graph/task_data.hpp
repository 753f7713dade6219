#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "runtime/data/bound_argument.hpp"
#include "runtime/data/label.hpp"

namespace tamp::runtime
{

/// The data of a task on one patch, as its body asks for them, by label:
///
///     [](const TaskContext& at, auto data) {
///       const auto old = data[temperature.previous()];
///       const auto now = data[temperature];
///     }
///
/// The answer is a span of particles, a GridView of nodes or cells, one of these for each group, or the value of a
/// reduction or a global; const where it is only read. A label that the task did not declare does not compile. What
/// only some tasks declare is used under `if constexpr (data.has(label))`; where `data` is a reference, under
/// `Data::has(label)`.
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
  explicit TaskData(const BoundArgument* bound) : bound_(bound) {}

  /// Whether a label is declared, of this step or of the one before.
  template <class T, Centring C, LabelName Name>
  static constexpr bool has(const NamedLabel<T, C, Name>&)
  {
    using L = NamedLabel<T, C, Name>;
    return is_declared<Reference<L>> || is_declared<Reference<L, true>>;
  }

  template <class L, bool Previous>
  requires is_declared<Reference<L, Previous>>
  decltype(auto) operator[](const Reference<L, Previous>&) const
  {
    constexpr std::size_t i = place<Reference<L, Previous>>;
    return std::tuple_element_t<i, std::tuple<Arguments...>>::view(bound_[i]);
  }
  template <class T, Centring C, LabelName Name>
  requires is_declared<Reference<NamedLabel<T, C, Name>>>
  decltype(auto) operator[](const NamedLabel<T, C, Name>& label) const { return (*this)[label.reference()]; }

 private:
  const BoundArgument* bound_;
};

}  // namespace tamp::runtime
