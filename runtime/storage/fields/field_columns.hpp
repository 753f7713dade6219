#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "runtime/grid/index_box.hpp"
#include "runtime/storage/row_share.hpp"

namespace tamp::runtime
{

/// The kind of a column's items. A vector has 2 or 3 components; a symmetric tensor has (xx, yy, zz, xy) or (xx, yy,
/// zz, xy, yz, xz).
enum class ColumnKind { scalar, vector, tensor };

/// Named values of consecutive items, component by component; whole numbers (ids) are scalars.
struct Column {
  std::string name;
  ColumnKind kind;
  std::variant<std::span<const double>, std::span<const std::int64_t>> values;
};

/// The `n` particles of one group that this rank has. One of the columns is the vector "position".
struct ParticleBlock {
  std::string name;
  std::size_t n;
  std::vector<Column> columns;
  /// Where they stand among those of all ranks; left out, they are all there are.
  std::optional<RowShare> share = std::nullopt;
};

/// Fields on the nodes of a uniform grid, x fastest. In two dimensions the third number of nodes is 1.
struct NodeBlock {
  std::array<double, 3> origin{0, 0, 0};
  double spacing = 1;
  std::array<int, 3> n_nodes{1, 1, 1};
  std::vector<Column> columns;
  /// The nodes whose values this rank gives, box after box, x fastest in each; no node is in two boxes, of any rank.
  /// Left out, the values are those of all nodes.
  std::optional<std::vector<IndexBox>> boxes = std::nullopt;
};

/// Components that an item has in a file: 1, 3, or 6 in the order (xx, xy, xz, yy, yz, zz) that XDMF calls Tensor6.
std::size_t n_in_file(ColumnKind kind);

/// Throws std::invalid_argument if a column has not the values of `n_items` items.
void check(const Column& column, std::size_t n_items);

/// The values of `n_items` items as they stand in a file, components that were left out filled in with 0. Of a column
/// of numbers that passes the check.
std::vector<double> as_in_file(const Column& column, std::size_t n_items);

}  // namespace tamp::runtime
