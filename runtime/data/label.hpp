#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace tamp::runtime
{

/// Where the values of a label sit.
enum class Centring { node, cell, particle, reduction };

const char* to_string(Centring centring);

/// What a reduction does with the bytes of its values.
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

/// How a task refers to a label; made by the label and refined by chaining: `position.previous()`,
/// `mass.halo(1).every_group()`.
template <class T, Centring C, bool EveryGroup = false>
struct Reference {
  const Label* label;
  bool of_previous_step = false;
  int halo_width = 0;

  /// The value at the end of the step before.
  Reference previous() const { return {label, true, halo_width}; }
  /// With `width` layers beyond the patch.
  Reference halo(int width) const { return {label, of_previous_step, width}; }
  /// The fields of all groups at once, for a task that runs once a patch.
  Reference<T, C, true> every_group() const { return {label, of_previous_step, halo_width}; }
};

/// A label whose values have type T. T must survive being copied as bytes: it travels between patches and into files.
///
/// For a reduction, a default T is the neutral value and `void T::combine(const T&)` takes another part in; parts are
/// combined in the order of patch, then group, whatever the threads.
template <class T, Centring C>
class TypedLabel : public Label
{
 public:
  explicit TypedLabel(std::string name) : Label(std::move(name), C, sizeof(T), operations(), adder()) {}

  operator Reference<T, C>() const { return {this}; }
  Reference<T, C> previous() const { return Reference<T, C>{this}.previous(); }
  Reference<T, C> halo(int width) const { return Reference<T, C>{this}.halo(width); }
  Reference<T, C, true> every_group() const { return Reference<T, C>{this}.every_group(); }

 private:
  static const ReductionOperations* operations()
  {
    if constexpr (C == Centring::reduction) {
      static constexpr ReductionOperations reduce{
          [](void* value) { *static_cast<T*>(value) = T{}; },
          [](void* into, const void* part) { static_cast<T*>(into)->combine(*static_cast<const T*>(part)); }};
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

/// Whether tasks can accumulate what a label, or a reference to one, names.
template <class L>
inline constexpr bool can_accumulate = false;
template <class T, Centring C>
inline constexpr bool can_accumulate<TypedLabel<T, C>> = Addable<T>;
template <class T, Centring C, bool EveryGroup>
inline constexpr bool can_accumulate<Reference<T, C, EveryGroup>> = Addable<T>;

template <class T>
using NodeLabel = TypedLabel<T, Centring::node>;
template <class T>
using CellLabel = TypedLabel<T, Centring::cell>;
template <class T>
using ParticleLabel = TypedLabel<T, Centring::particle>;
template <class T>
using ReductionLabel = TypedLabel<T, Centring::reduction>;

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
  }
  return "";
}

}  // namespace tamp::runtime
