#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "runtime/data/field.hpp"
#include "runtime/data/label.hpp"
#include "runtime/data/views.hpp"

namespace tamp::runtime
{

/// A declared label of one task instance, tied to its storage.
struct BoundArgument {
  /// Its field, or one for each group.
  Field* const* fields = nullptr;
  std::size_t n_fields = 1;
  /// Which of a field's buffers this is.
  FieldBuffer buffer = FieldBuffer::current;
  /// For node and cell fields: the patch with the declared halo.
  IndexBox box;
};

/// A declared label of a task, as its type: what a body asks for, and how the view that it gets is made.
template <class L, bool Previous, bool EveryGroup, bool ReadOnly>
struct Argument {
  /// The key by which a body asks for this.
  using Asked = Reference<L, Previous>;
  using Value = std::conditional_t<ReadOnly, const typename L::Value, typename L::Value>;

  /// A span of particles, or a GridView, or one for each group; of a reduction or a global the value itself. Empty
  /// or a default without an argument, where the label was not declared.
  static decltype(auto) view(const BoundArgument* bound)
  {
    if constexpr (has_one_value(L::centre)) {
      static Value none{};
      return bound == nullptr ? none : *reinterpret_cast<Value*>(bound->fields[0]->buffer(bound->buffer).data());
    } else if constexpr (EveryGroup) {
      PerGroup<decltype(one(*bound, 0))> views;
      for (std::size_t g = 0; bound != nullptr && g < bound->n_fields; ++g) views.push_back(one(*bound, g));
      return views;
    } else {
      return bound == nullptr ? decltype(one(*bound, 0))() : one(*bound, 0);
    }
  }

 private:
  static auto one(const BoundArgument& bound, std::size_t group)
  {
    const Field& field = *bound.fields[group];
    auto* const first = reinterpret_cast<Value*>(field.values(bound.buffer));
    if constexpr (L::centre == Centring::particle) {
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

}  // namespace tamp::runtime
