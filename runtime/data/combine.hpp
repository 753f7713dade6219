#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

/// How the parts of a reduction make a whole. A struct lists its members in `fields`, a tuple: a bare member pointer is
/// summed, others say their rule. One that forgets a member does not compile. A default struct is neutral.
///
///     struct Motion {
///       double momentum = 0;
///       double greatest_speed = 0;
///
///       static constexpr auto fields = std::tuple{&Motion::momentum, Greatest{&Motion::greatest_speed}};
///     };
///
/// Structs that list their members may be members, and so may arrays, which are combined element by element.
namespace tamp::runtime
{

/// Calls `act` with two values, or with each two elements of arrays.
template <class Act, class T>
void for_each_pair(const Act& act, T& a, const T& b)
{
  act(a, b);
}
template <class Act, class T, std::size_t n>
void for_each_pair(const Act& act, std::array<T, n>& a, const std::array<T, n>& b)
{
  for (std::size_t k = 0; k < n; ++k) for_each_pair(act, a[k], b[k]);
}

/// The rules, whose guides clang 14 needs: of values with a <, the least or the greatest; of whole numbers all bits
/// that are set in any part.
template <class Struct, class Member>
struct Least {
  Member Struct::*member;

  static void combine(Member& into, const Member& part)
  {
    for_each_pair([](auto& a, const auto& b) { a = std::min(a, b); }, into, part);
  }
};
template <class Struct, class Member>
Least(Member Struct::*) -> Least<Struct, Member>;
template <class Struct, class Member>
struct Greatest {
  Member Struct::*member;

  static void combine(Member& into, const Member& part)
  {
    for_each_pair([](auto& a, const auto& b) { a = std::max(a, b); }, into, part);
  }
};
template <class Struct, class Member>
Greatest(Member Struct::*) -> Greatest<Struct, Member>;
template <class Struct, class Member>
struct AnyBit {
  Member Struct::*member;

  static void combine(Member& into, const Member& part)
  {
    for_each_pair([](auto& a, const auto& b) { a |= b; }, into, part);
  }
};
template <class Struct, class Member>
AnyBit(Member Struct::*) -> AnyBit<Struct, Member>;

template <class T>
void combine(T& into, const T& part);

/// The rule of a bare member pointer: members are combined by their own rules.
template <class Struct, class Member>
struct Sum {
  Member Struct::*member;

  static void combine(Member& into, const Member& part)
  {
    for_each_pair([](auto& a, const auto& b) { runtime::combine(a, b); }, into, part);
  }
};

template <class Rule>
constexpr Rule rule_of(Rule rule)
{
  return rule;
}
template <class Struct, class Member>
constexpr auto rule_of(Member Struct::*member)
{
  return Sum<Struct, Member>{member};
}

template <class Struct, class Member>
constexpr std::size_t bytes_of(Member Struct::*)
{
  return sizeof(Member);
}
template <class A, class B>
constexpr bool is_same_member(A a, B b)
{
  if constexpr (std::is_same_v<A, B>) return a == b;
  return false;
}

/// Whether `fields` has every member of a struct, once. Their sizes must add up to the struct's: there can be no gap,
/// which could hide one.
template <class T>
constexpr bool lists_all_members = std::apply(
    [](auto... field) {
      const auto times = [&](auto member) { return (0 + ... + int{is_same_member(member, rule_of(field).member)}); };
      const std::size_t n_bytes = (std::size_t{0} + ... + bytes_of(rule_of(field).member));
      return n_bytes == sizeof(T) && (... && (times(rule_of(field).member) == 1));
    },
    T::fields);

/// Takes a part into a whole: of numbers, vectors and matrices their sum.
template <class T>
void combine(T& into, const T& part)
{
  if constexpr (requires { T::fields; }) {
    static_assert(lists_all_members<T>, "a member of the struct is not in its `fields`, or there is a gap");
    std::apply(
        [&](auto... field) { (rule_of(field).combine(into.*rule_of(field).member, part.*rule_of(field).member), ...); },
        T::fields);
  } else {
    static_assert(
        std::is_arithmetic_v<T> || requires { typename T::Scalar; }, "a struct lists its members in `fields`");
    into += part;
  }
}

}  // namespace tamp::runtime
