#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tamp::runtime
{

/// What one item of a column is. A vector has 2 or 3 components; a symmetric tensor has (xx, yy, zz, xy) or
/// (xx, yy, zz, xy, yz, xz).
enum class ColumnKind { scalar, vector, tensor };

/// Named values of consecutive items, component by component; whole numbers (ids) are scalars.
struct Column {
  std::string name;
  ColumnKind kind;
  std::variant<std::span<const double>, std::span<const std::int64_t>> values;
};

/// The `n` particles of one group. One of the columns is the vector "position".
struct ParticleBlock {
  std::string name;
  std::size_t n;
  std::vector<Column> columns;
};

/// Fields on the nodes of a uniform grid, x fastest. In two dimensions the third number of nodes is 1.
struct NodeBlock {
  std::array<double, 3> origin{0, 0, 0};
  double spacing = 1;
  std::array<int, 3> n_nodes{1, 1, 1};
  std::vector<Column> columns;
};

/// Components that an item has in a file: 1, 3, or 6 in the order (xx, xy, xz, yy, yz, zz) that XDMF calls Tensor6.
std::size_t n_in_file(ColumnKind kind);

/// The values of `n_items` items as they stand in a file, components that were left out filled in with 0. Throws
/// std::invalid_argument if their number does not fit.
std::vector<double> as_in_file(const Column& column, std::size_t n_items);

}  // namespace tamp::runtime
