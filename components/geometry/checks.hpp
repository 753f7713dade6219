#pragma once

#include <string>

#include "components/tensors.hpp"

/// Checks of the numbers of shapes. Each throws BadValue, with the name of what is wrong.
namespace tamp::components
{

/// The vector in words, such as [0.1, 2].
template <int D>
std::string text(const Vector<D>& v);

template <int D>
void require_finite(const Vector<D>& v, const char* name);

/// A finite length above 0.
void require_positive(double length, const char* name);

/// An orthogonal matrix of determinant 1.
template <int D>
void require_rotation(const Matrix<D>& rotation);

}  // namespace tamp::components
