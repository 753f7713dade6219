#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/storage/fields/field_columns.hpp"

namespace tamp::runtime
{

/// A dataset of an HDF5 file.
struct XdmfColumn {
  std::string name;
  ColumnKind kind;
  bool whole_numbers = false;
  /// File and path of the dataset, such as fields.h5:/step_00000012/nodes/mass.
  std::string dataset;
};

struct XdmfParticles {
  std::string name;
  std::size_t n;
  std::vector<XdmfColumn> columns;
};

struct XdmfNodes {
  std::array<double, 3> origin;
  double spacing;
  std::array<int, 3> n_nodes;
  std::vector<XdmfColumn> columns;
};

/// A dataset of the whole numbers from 0 on.
struct XdmfVertices {
  std::string dataset;
  std::size_t n;
};

/// The fields at one time.
struct XdmfStep {
  double time;
  std::vector<XdmfParticles> particles;
  std::optional<XdmfNodes> nodes;
  /// Which particle each point is, where no step before it has as many.
  std::optional<XdmfVertices> vertices;
};

/// An XDMF document (version 3): a collection in time of collections in space, of particles as points and of the nodes
/// as one uniform grid. A plane grid is a space grid of one layer, which readers agree on more than on plane ones.
/// Blocks without particles are left out. Points name their particle, as some of ParaView's readers show no others.
std::string xdmf_text(std::span<const XdmfStep> steps);

}  // namespace tamp::runtime
