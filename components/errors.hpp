#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace tamp::components
{

/// A value that a component cannot be made from. Who read it from a file adds where it stood.
struct BadValue : std::runtime_error {
  /// `row` counts from 0 within a table; -1 where the value is not in one.
  BadValue(std::string found_, std::string expected_, std::ptrdiff_t row_ = -1)
      : std::runtime_error(found_ + "; expected " + expected_),
        found(std::move(found_)),
        expected(std::move(expected_)),
        row(row_)
  {
  }

  std::string found;
  std::string expected;
  std::ptrdiff_t row;
};

/// Why the stress of a particle could not be updated; `particle` is its place in the batch.
struct UpdateFailure {
  std::size_t particle;
  std::string reason;
};

}  // namespace tamp::components
