#include "tests/scenes/count_allocations.hpp"

#include <atomic>
#include <cerrno>

// Functions of a program come before those of its libraries: what these libraries call are the ones below, and so does
// operator new. The allocator itself is still that of the C library, by the names that it keeps for such cases.

namespace
{

constinit std::atomic<long> n_calls{0};

#if defined(__GLIBC__) && !TAMP_SANITIZED
void count()
{
  n_calls.fetch_add(1, std::memory_order_relaxed);
}
#endif

}  // namespace

namespace tamp::test
{

long n_allocations()
{
  return n_calls.load();
}

}  // namespace tamp::test

#if defined(__GLIBC__) && !TAMP_SANITIZED

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier): glibc names them so.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t size) noexcept
{
  count();
  return __libc_malloc(size);
}

void* calloc(std::size_t n, std::size_t size) noexcept
{
  count();
  return __libc_calloc(n, size);
}

void* realloc(void* block, std::size_t size) noexcept
{
  count();
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept
{
  count();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
  return memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept
{
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
}

#endif
