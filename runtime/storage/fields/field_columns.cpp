#include "runtime/storage/fields/field_columns.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace tamp::runtime
{

namespace
{

/// Which component of a file's tensor each of (xx, yy, zz, xy, yz, xz) is.
constexpr std::array<std::size_t, 6> tensor_place{0, 3, 5, 1, 4, 2};

bool fits(ColumnKind kind, std::size_t n_components)
{
  switch (kind) {
    case ColumnKind::scalar:
      return n_components == 1;
    case ColumnKind::vector:
      return n_components == 2 || n_components == 3;
    case ColumnKind::tensor:
      return n_components == 4 || n_components == 6;
  }
  return false;
}

}  // namespace

std::size_t n_in_file(ColumnKind kind)
{
  switch (kind) {
    case ColumnKind::scalar:
      return 1;
    case ColumnKind::vector:
      return 3;
    case ColumnKind::tensor:
      return 6;
  }
  return 0;
}

void check(const Column& column, std::size_t n_items)
{
  const bool ids = std::holds_alternative<std::span<const std::int64_t>>(column.values);
  const std::size_t n_values = std::visit([](const auto& values) { return values.size(); }, column.values);
  const std::size_t n = n_items == 0 ? 0 : n_values / n_items;
  const bool right =
      n * n_items == n_values && (n_items == 0 || fits(column.kind, n)) && (!ids || column.kind == ColumnKind::scalar);
  if (right) return;
  throw std::invalid_argument(
      fmt::format("column '{}': {} {} for {} items", column.name, n_values, ids ? "ids" : "values", n_items));
}

std::vector<double> as_in_file(const Column& column, std::size_t n_items)
{
  if (n_items == 0) return {};
  const auto& values = std::get<std::span<const double>>(column.values);
  const std::size_t n = values.size() / n_items;
  const std::size_t n_file = n_in_file(column.kind);
  std::vector<double> out(n_items * n_file, 0.0);
  for (std::size_t i = 0; i < n_items; ++i) {
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t place = column.kind == ColumnKind::tensor ? tensor_place[c] : c;
      out[i * n_file + place] = values[i * n + c];
    }
  }
  return out;
}

}  // namespace tamp::runtime
