#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

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

/// A number of a scene that does not go with the others.
struct BadParameter : BadValue {
  BadParameter(std::string key_, std::string found_, std::string expected_)
      : BadValue(std::move(found_), std::move(expected_)), key(std::move(key_))
  {
  }

  std::string key;
};

/// Why the stress of a particle could not be updated.
enum class UpdateFault { not_finite, too_large, no_return };

inline const char* to_string(UpdateFault fault)
{
  switch (fault) {
    case UpdateFault::not_finite:
      return "its strain increment, stress or state is not finite";
    case UpdateFault::too_large:
      return "its strain increment in one step is larger than 0.2";
    case UpdateFault::no_return:
      return "no stress on the yield surface was found";
  }
  return "";
}

/// `particle` is its place in the batch.
struct UpdateFailure {
  std::size_t particle;
  UpdateFault fault;
};

}  // namespace tamp::components
