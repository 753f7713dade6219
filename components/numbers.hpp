#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include "components/lanes.hpp"

namespace tamp
{

/// Structs of numbers, over which one can loop: they list their members in `fields`, a tuple of member pointers. A
/// member may be such a struct itself.

/// Calls `act` with each number of a struct, and with the same of others of its shape.
template <class Act, class First, class... Others>
[[gnu::always_inline]] inline void for_each_number(Act&& act, First& first, Others&... others)
{
  if constexpr (requires { First::fields; }) {
    const auto visit = [&](auto field) __attribute__((always_inline))
    {
      for_each_number(act, first.*field, (others.*field)...);
    };
    [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline))
    {
      (visit(std::get<k>(First::fields)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(First::fields)>>());
  } else {
    act(first, others...);
  }
}

/// How many numbers a struct has.
template <class Values>
constexpr std::size_t count_numbers()
{
  if constexpr (requires { Values::fields; }) {
    return std::apply(
        []<class... Member>(Member Values::*...) { return (std::size_t{0} + ... + count_numbers<Member>()); },
        Values::fields);
  } else {
    return 1;
  }
}

/// Takes over each number of `from` in the lanes where `which` holds.
template <class Values>
[[gnu::always_inline]] inline void assign_where(const Mask<Lanes>& which, const Values& from, Values& to)
{
  for_each_number([&](const Lanes& a, Lanes& b) { b = select(which, a, b); }, from, to);
}

}  // namespace tamp
