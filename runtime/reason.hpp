#pragma once

#include <exception>
#include <new>

namespace tamp::runtime
{

/// Why something failed, for people: what a library says of memory that has run out is a name of its own.
inline const char* reason(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "out of memory" : error.what();
}

}  // namespace tamp::runtime
