#pragma once

#include <cstddef>
#include <span>

#include "runtime/data/field.hpp"
#include "runtime/data/label.hpp"
#include "runtime/data/views.hpp"

namespace tamp::runtime
{

/// One declared label of one task instance, tied to its storage.
struct BoundArgument {
  /// Its field, or one for each group.
  Field* const* fields = nullptr;
  std::size_t n_fields = 1;
  /// Which of a field's buffers this is.
  FieldBuffer buffer = FieldBuffer::current;
  /// For node and cell fields: the patch with the declared halo.
  IndexBox box;
};

/// The type of one argument of a task body and how it is made from what was bound.
template <class T, Centring C, bool ReadOnly, bool EveryGroup>
struct Argument {
  using Value = std::conditional_t<ReadOnly, const T, T>;

  static auto view(const BoundArgument& bound)
  {
    if constexpr (EveryGroup) {
      PerGroup<decltype(one(bound, 0))> views;
      for (std::size_t g = 0; g < bound.n_fields; ++g) views.push_back(one(bound, g));
      return views;
    } else {
      return one(bound, 0);
    }
  }

 private:
  static auto one(const BoundArgument& bound, std::size_t group)
  {
    const Field& field = *bound.fields[group];
    auto* const first = reinterpret_cast<Value*>(field.buffer(bound.buffer).data());
    if constexpr (C == Centring::particle) {
      return std::span<Value>(first, *field.n_particles);
    } else {
      const auto strides = field.box.strides();
      const std::ptrdiff_t offset = (bound.box.lower[0] - field.box.lower[0]) +
                                    strides[1] * (bound.box.lower[1] - field.box.lower[1]) +
                                    strides[2] * (bound.box.lower[2] - field.box.lower[2]);
      return GridView<Value>(first + offset, bound.box, strides);
    }
  }
};

/// A reduction is one value, not a view.
template <class T, bool ReadOnly, bool EveryGroup>
struct Argument<T, Centring::reduction, ReadOnly, EveryGroup> {
  using Value = std::conditional_t<ReadOnly, const T, T>;
  static Value& view(const BoundArgument& bound)
  {
    return *reinterpret_cast<Value*>(bound.fields[0]->buffer(bound.buffer).data());
  }
};

}  // namespace tamp::runtime
