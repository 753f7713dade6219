#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace tamp::components
{

/// Calls `visit(std::type_identity<T>())` for each alternative T of a variant, in their order.
template <class Variant, class Visit>
void for_each_alternative(Visit&& visit)
{
  [&]<std::size_t... i>(std::index_sequence<i...>)
  {
    (visit(std::type_identity<std::variant_alternative_t<i, Variant>>()), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

}  // namespace tamp::components
