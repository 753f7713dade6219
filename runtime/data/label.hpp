#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "runtime/data/combine.hpp"

namespace tamp::runtime
{

/// Where the values of a label sit. Reductions and globals have one value, which all ranks hold alike: a reduction is
/// made of the parts of all patches, a global by a task that every rank runs.
enum class Centring { node, cell, particle, reduction, global };

const char* to_string(Centring centring);

constexpr bool is_on_grid(Centring centring)
{
  return centring == Centring::node || centring == Centring::cell;
}
constexpr bool has_one_value(Centring centring)
{
  return centring == Centring::reduction || centring == Centring::global;
}

/// The operations of a reduction on the bytes of its values.
struct ReductionOperations {
  void (*reset)(void* value);
  void (*combine)(void* into, const void* part);
};

/// A value to whose sum patches can each add a part.
template <class T>
concept Addable = requires(T& sum, const T& part)
{
  sum += part;
};

/// Adds values, as many as there are in `n_bytes`, to others, each by its type's own +=.
using AddValues = void (*)(std::byte* sums, const std::byte* parts, std::size_t n_bytes);

/// The name of a field. Two labels are the same only when they are the same object, so a label is declared once, as
/// an inline constant, and referred to ever after.
class Label
{
 public:
  Label(std::string name, Centring centring, std::size_t value_bytes, const ReductionOperations* reduction,
        AddValues add_values)
      : name_(std::move(name)), centring_(centring), value_bytes_(value_bytes), reduction_(reduction), add_(add_values)
  {
  }
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;

  const std::string& name() const { return name_; }
  Centring centring() const { return centring_; }
  std::size_t value_bytes() const { return value_bytes_; }
  /// Null unless the centring is `reduction`.
  const ReductionOperations* reduction() const { return reduction_; }
  /// Null unless its values are Addable.
  AddValues add() const { return add_; }

 private:
  std::string name_;
  Centring centring_;
  std::size_t value_bytes_;
  const ReductionOperations* reduction_;
  AddValues add_;
};

/// A label with the type of its values. T must survive being copied as bytes: it travels between patches and into
/// files.
///
/// For a reduction, a default T is the neutral value, and its parts combine as `combine.hpp` says. One that is state is
/// accumulated: its value of each step is combined into that of all steps before, which `previous()` reads.
template <class T, Centring C>
class TypedLabel : public Label
{
 public:
  using Value = T;
  static constexpr Centring centre = C;

 protected:
  explicit TypedLabel(std::string name) : Label(std::move(name), C, sizeof(T), operations(), adder()) {}

 private:
  static const ReductionOperations* operations()
  {
    if constexpr (C == Centring::reduction) {
      static constexpr ReductionOperations reduce{
          [](void* value) { *static_cast<T*>(value) = T{}; },
          [](void* into, const void* part) { runtime::combine(*static_cast<T*>(into), *static_cast<const T*>(part)); }};
      return &reduce;
    } else {
      return nullptr;
    }
  }
  static AddValues adder()
  {
    if constexpr (Addable<T>) {
      return [](std::byte* sums, const std::byte* parts, std::size_t n_bytes) {
        auto* sum = reinterpret_cast<T*>(sums);
        const auto* part = reinterpret_cast<const T*>(parts);
        for (std::size_t i = 0; i < n_bytes / sizeof(T); ++i) sum[i] += part[i];
      };
    } else {
      return nullptr;
    }
  }
};

/// The name of a label, as an argument of its type.
template <std::size_t N>
struct LabelName {
  constexpr LabelName(const char (&letters)[N]) { std::copy_n(letters, N, text.begin()); }
  std::array<char, N> text{};
};

/// The two states of a label that a step knows: the one that it finds, and the one that it makes.
enum class StepEnd { start, end };

/// How a task refers to a label; made by the label and refined by chaining: `position.previous()`,
/// `mass.halo(1).every_group()`, `spin.when(scene.turns)`.
template <class L, bool Previous = false, bool EveryGroup = false>
struct Reference {
  const L* label;
  int halo_width = 0;
  bool is_declared = true;
  bool is_anew = false;
  bool of_previous_step = Previous;

  /// The value at the end of the step before.
  Reference<L, true, EveryGroup> previous() const { return {label, halo_width, is_declared, is_anew, true}; }
  /// The value at the start of the step, as previous() has it, or at its end; the body asks for it by the plain label.
  Reference at(StepEnd end) const { return {label, halo_width, is_declared, is_anew, end == StepEnd::start}; }
  /// The label with `width` layers beyond the patch.
  Reference halo(int width) const { return {label, width, is_declared, is_anew, of_previous_step}; }
  /// The fields of all groups at once, for a task that runs once a patch.
  Reference<L, Previous, true> every_group() const
  {
    return {label, halo_width, is_declared, is_anew, of_previous_step};
  }
  /// Declared only on this condition, which is asked once, here. Without it the body gets an empty span or view; of a
  /// reduction or a global, which it can only read so, a default value.
  Reference when(bool condition) const
  {
    return {label, halo_width, is_declared && condition, is_anew, of_previous_step};
  }
  /// Accumulated from zero once more: readers declared before get the sum so far, those declared after a new one.
  Reference anew() const { return {label, halo_width, is_declared, true, of_previous_step}; }
};

/// A label whose name is part of its type, by which the body of a task asks for its data.
template <class T, Centring C, LabelName Name>
class NamedLabel : public TypedLabel<T, C>
{
 public:
  NamedLabel() : TypedLabel<T, C>(Name.text.data()) {}

  auto previous() const { return reference().previous(); }
  auto at(StepEnd end) const { return reference().at(end); }
  auto when(bool condition) const { return reference().when(condition); }
  auto anew() const { return reference().anew(); }
  auto halo(int width) const { return reference().halo(width); }
  auto every_group() const { return reference().every_group(); }
  Reference<NamedLabel> reference() const { return {this}; }
};

template <class T, LabelName Name>
using NodeLabel = NamedLabel<T, Centring::node, Name>;
template <class T, LabelName Name>
using CellLabel = NamedLabel<T, Centring::cell, Name>;
template <class T, LabelName Name>
using ParticleLabel = NamedLabel<T, Centring::particle, Name>;
template <class T, LabelName Name>
using ReductionLabel = NamedLabel<T, Centring::reduction, Name>;
template <class T, LabelName Name>
using GlobalLabel = NamedLabel<T, Centring::global, Name>;

inline const char* to_string(Centring centring)
{
  switch (centring) {
    case Centring::node:
      return "node";
    case Centring::cell:
      return "cell";
    case Centring::particle:
      return "particle";
    case Centring::reduction:
      return "reduction";
    case Centring::global:
      return "global";
  }
  return "";
}

}  // namespace tamp::runtime
