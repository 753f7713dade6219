#pragma once

#include <cstddef>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace tamp::runtime
{

/// Bytes that this program has asked for and not given back, as the C library of GNU counts them; 0 with others.
inline std::size_t heap_bytes()
{
#ifdef __GLIBC__
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

}  // namespace tamp::runtime
