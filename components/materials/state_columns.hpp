#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "components/materials/invariants.hpp"
#include "components/materials/material_batch.hpp"

namespace tamp::components
{

/// The outputs that show a number of the state.
enum class Shown { everywhere, in_field_files, by_drive };

/// A number of a particle's state in output, compression positive.
template <class Model>
struct StateColumn {
  std::string_view name;
  /// Its unit; empty for a count or a yes or no.
  std::string_view unit;
  double (*value)(const Model& model, const typename Model::State& state, const Invariants& stress);
  Shown shown = Shown::everywhere;
  /// Whether field files have it; nothing: they always do.
  bool (*is_written)(const Model& model) = nullptr;
};

/// A column of history.csv: the greatest or the least over a model's particles of one of its state's columns.
struct StateExtreme {
  std::size_t column;
  bool greatest = true;
};

/// The most columns or extremes a model may have: reports and failed updates have room for no more.
inline constexpr std::size_t max_state_columns = 8;

template <class Model>
std::span<const StateColumn<Model>> state_columns()
{
  if constexpr (has_state<Model>) {
    static_assert(decltype(Model::columns())::extent <= max_state_columns);
    return Model::columns();
  } else {
    return {};
  }
}

template <class Model>
std::span<const StateExtreme> state_extremes()
{
  if constexpr (has_state<Model>) {
    static_assert(decltype(Model::extremes())::extent <= max_state_columns);
    return Model::extremes();
  } else {
    return {};
  }
}

}  // namespace tamp::components
