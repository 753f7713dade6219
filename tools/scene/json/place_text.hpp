#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string>

#include "components/tensors.hpp"

namespace tamp::tools
{

/// A place as problems name it.
template <int D>
std::string text(const Vector<D>& v)
{
  return fmt::format("[{}]", fmt::join(v.data(), v.data() + D, ", "));
}

}  // namespace tamp::tools
