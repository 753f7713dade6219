#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace tamp::components
{

/// Calls `visit(std::type_identity<T>())` for each alternative T of a variant, in their order.
template <class Variant, class Visit>
constexpr void for_each_alternative(Visit&& visit)
{
  [&]<std::size_t... i>(std::index_sequence<i...>)
  {
    (visit(std::type_identity<std::variant_alternative_t<i, Variant>>()), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// Calls `visit(std::type_identity<T>())` for the alternative T of a variant that stands at place `i`.
template <class Variant, std::size_t from = 0, class Visit>
auto with_alternative(std::size_t i, Visit&& visit)
{
  if constexpr (from + 1 < std::variant_size_v<Variant>) {
    if (i != from) return with_alternative<Variant, from + 1>(i, visit);
  }
  return visit(std::type_identity<std::variant_alternative_t<from, Variant>>());
}

}  // namespace tamp::components
