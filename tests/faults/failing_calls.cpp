/// A library to be loaded before others (LD_PRELOAD): it lets one call of a program fail, once, or a disk be slow.
///
///  - TAMP_FAIL_CALL: write, pwrite, fwrite, fflush, fsync, rename, fallocate, malloc, pthread_create, or an HDF5 call
///  - TAMP_FAIL_AT: which of these calls; 1 is the first
///  - TAMP_FAIL_PATH: only calls for files whose path has this in it count
///  - TAMP_FAIL_SIZE: only allocations of so many bytes or more count
///  - TAMP_FAIL_WHEN: calls count from when this file is there
///  - TAMP_SLOW_FSYNC: milliseconds that every fsync takes longer
#include <dlfcn.h>
#include <fcntl.h>
#include <hdf5.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

const char* setting(const char* name)
{
  const char* text = std::getenv(name);
  return text == nullptr ? "" : text;
}

bool is_time()
{
  static std::atomic<bool> now{false};
  const char* file = setting("TAMP_FAIL_WHEN");
  if (!now && (*file == 0 || access(file, F_OK) == 0)) now = true;
  return now;
}

/// Whether this call is the one; nothing is allocated on the way.
bool fails(const char* call, const char* path = nullptr)
{
  static std::atomic<long> n_calls{0};
  if (std::strcmp(setting("TAMP_FAIL_CALL"), call) != 0) return false;
  if (path != nullptr && std::strstr(path, setting("TAMP_FAIL_PATH")) == nullptr) return false;
  return is_time() && ++n_calls == std::atol(setting("TAMP_FAIL_AT"));
}

bool fails(const char* call, int descriptor)
{
  char link[64], path[4096] = "";
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  return readlink(link, path, sizeof path - 1) > 0 && fails(call, path);
}

bool fails_of_disk(const char* call, int descriptor)
{
  if (!fails(call, descriptor)) return false;
  errno = ENOSPC;
  return true;
}

template <class Function>
Function* next(Function*, const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);  // NOLINT(bugprone-reserved-identifier): glibc's own

void* malloc(std::size_t n)
{
  if (n >= static_cast<std::size_t>(std::atol(setting("TAMP_FAIL_SIZE"))) && fails("malloc")) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(n);
}

ssize_t write(int file, const void* data, std::size_t n)
{
  static auto* const real = next(&write, "write");
  return fails_of_disk("write", file) ? -1 : real(file, data, n);
}

ssize_t pwrite(int file, const void* data, std::size_t n, off_t at)
{
  static auto* const real = next(&pwrite, "pwrite");
  return fails_of_disk("pwrite", file) ? -1 : real(file, data, n, at);
}

ssize_t pwrite64(int file, const void* data, std::size_t n, off64_t at)
{
  static auto* const real = next(&pwrite64, "pwrite64");
  return fails_of_disk("pwrite", file) ? -1 : real(file, data, n, at);
}

std::size_t fwrite(const void* data, std::size_t size, std::size_t n, std::FILE* stream)
{
  static auto* const real = next(&fwrite, "fwrite");
  return fails_of_disk("fwrite", fileno(stream)) ? 0 : real(data, size, n, stream);
}

int fflush(std::FILE* stream)
{
  static auto* const real = next(&fflush, "fflush");
  return stream != nullptr && fails_of_disk("fflush", fileno(stream)) ? EOF : real(stream);
}

int fsync(int file)
{
  static auto* const real = next(&fsync, "fsync");
  usleep(1000 * static_cast<useconds_t>(std::atol(setting("TAMP_SLOW_FSYNC"))));
  return fails_of_disk("fsync", file) ? -1 : real(file);
}

int posix_fallocate(int file, off_t at, off_t n)
{
  static auto* const real = next(&posix_fallocate, "posix_fallocate");
  return fails_of_disk("fallocate", file) ? ENOSPC : real(file, at, n);
}

int rename(const char* from, const char* to)
{
  static auto* const real = next(&rename, "rename");
  if (!fails("rename", to)) return real(from, to);
  errno = EACCES;
  return -1;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument)
{
  static auto* const real = next(&pthread_create, "pthread_create");
  return fails("pthread_create") ? EAGAIN : real(thread, attributes, work, argument);
}

herr_t H5Dwrite(hid_t set, hid_t in_memory, hid_t memory, hid_t file, hid_t access, const void* data)
{
  static auto* const real = next(&H5Dwrite, "H5Dwrite");
  return fails("H5Dwrite") ? -1 : real(set, in_memory, memory, file, access, data);
}

herr_t H5Fclose(hid_t file)
{
  static auto* const real = next(&H5Fclose, "H5Fclose");
  return fails("H5Fclose") ? -1 : real(file);
}

hid_t H5Dcreate2(hid_t at, const char* name, hid_t type, hid_t space, hid_t link, hid_t creation, hid_t access)
{
  static auto* const real = next(&H5Dcreate2, "H5Dcreate2");
  return fails("H5Dcreate2") ? -1 : real(at, name, type, space, link, creation, access);
}
}
