#pragma once

#include "tools/run/drive/path.hpp"

namespace tamp::tools
{

/// The norm of the strain from one deformation gradient to another; infinite where that turns the point inside out.
double strain_between(const Matrix<3>& from, const Matrix<3>& to);

/// How many equal increments of time a segment is cut into: as few as keep the strain of each within `largest_strain`,
/// and the superposed rotation within 0.1 rad.
std::size_t n_increments(const DeformationPath& path, std::size_t segment, double largest_strain);

}  // namespace tamp::tools
