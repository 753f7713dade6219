/// A library to be loaded before others (LD_PRELOAD): it lets one call of a program fail, once, or a disk be slow.
///
///  - TAMP_FAIL_CALL: write, pwrite, fwrite, fflush, fclose, fsync, ftruncate, rename, fallocate, malloc (all of C's
///  allocations, by which
///    C++ allocates, too), new (C++'s alone), pthread_create, or an HDF5 call
///  - TAMP_FAIL_AT: which of these calls; 1 is the first
///  - TAMP_FAIL_NOTE: a file that the call which fails makes, with its stack; where it is there already none fails, so
///    that of several processes one has a fault
///  - TAMP_FAIL_PLACES: a file to which the number of the first call from each place, by its whole stack, is added
///  - TAMP_FAIL_PATH: only calls for files whose path has this in it count
///  - TAMP_FAIL_SIZE: only allocations of so many bytes or more count
///  - TAMP_FAIL_WHEN: calls count from when this file is there
///  - TAMP_SLOW_FSYNC: milliseconds that every fsync takes longer
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <hdf5.h>
#include <link.h>
#include <pthread.h>
#include <sys/auxv.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

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

/// The program's own code is `""` to the loader, whose file starts at `entry` and has no more of its own than a jump to
/// main. What libraries do before main, after it and in threads of theirs does not have it on the stack.
bool is_of_program(void* place)
{
  dl_find_object found;
  constexpr std::uintptr_t length_of_entry = 64;
  static const std::uintptr_t entry = getauxval(AT_ENTRY);
  const std::uintptr_t from_entry = reinterpret_cast<std::uintptr_t>(place) - entry;
  return _dl_find_object(place, &found) == 0 && *found.dlfo_link_map->l_name == 0 && from_entry > length_of_entry;
}

/// HDF5, when it begins, follows pointers that no memory was found for, or ends the program by itself. Its first call
/// comes before anything is opened, and whether its functions' own allocations fail is tried after it.
bool is_start_of_hdf5(void* place)
{
  static const char* const begin = [] { return static_cast<const char*>(dlsym(RTLD_DEFAULT, "H5_init_library")); }();
  static const std::size_t length = [] {
    Dl_info info;
    const ElfW(Sym)* symbol = nullptr;
    void* const extra = static_cast<void*>(&symbol);
    const bool found = dladdr1(begin, &info, static_cast<void**>(extra), RTLD_DL_SYMENT) != 0 && symbol != nullptr;
    return found ? symbol->st_size : 0;
  }();
  return begin <= place && place < begin + length;
}

/// The stack of a call.
class Stack
{
 public:
  Stack() : n_(backtrace(frames_, most)) {}
  bool has(bool (*is_so)(void*)) const { return std::any_of(frames_, frames_ + n_, is_so); }
  /// Whether the file was there or could be made, as `flags` have it.
  bool write_to(const char* file, int flags) const
  {
    const int descriptor = open(file, O_WRONLY | O_CLOEXEC | flags, 0644);
    if (descriptor < 0) return false;
    backtrace_symbols_fd(frames_, n_, descriptor);
    close(descriptor);
    return true;
  }
  std::uint64_t hash() const
  {
    std::uint64_t sum = 14695981039346656037U;
    for (int i = 0; i < n_; ++i) sum = (sum ^ reinterpret_cast<std::uintptr_t>(frames_[i])) * 1099511628211U;
    return sum;
  }

 private:
  static constexpr int most = 400;
  void* frames_[most];
  int n_;
};

/// The first walk of a stack loads what it needs, and allocates. Done before the program begins, whose calls alone
/// count.
bool can_walk_stacks = false;
[[maybe_unused]] const Stack first_stack;
[[maybe_unused]] const bool walked = can_walk_stacks = true;

const char* note_of_failure = "";

/// Adds the stack at a program's end to the note of what has failed.
void note_end(const char* word)
{
  if (*note_of_failure == 0) return;
  const int descriptor = open(note_of_failure, O_WRONLY | O_APPEND | O_CLOEXEC);
  syscall(SYS_write, descriptor, word, std::strlen(word));
  close(descriptor);
  Stack().write_to(note_of_failure, O_APPEND);
}

void note_crash(int signal)
{
  note_end("crashed\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Makes the note of this stack, if there is none yet, in which the stack of a crash follows.
bool note_failure(const Stack& stack)
{
  static const char* const note = setting("TAMP_FAIL_NOTE");
  if (*note == 0) return true;
  if (!stack.write_to(note, O_CREAT | O_EXCL)) return false;
  note_of_failure = note;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, note_crash);
  return true;
}

/// Adds the number of a call to the file of places if no call before had its stack.
void note_place(const Stack& stack, long number)
{
  static const int file = open(setting("TAMP_FAIL_PLACES"), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0644);
  static std::array<std::atomic<std::uint64_t>, 1 << 16> known{};
  const std::uint64_t hash = stack.hash();
  for (std::uint64_t i = 0; i < known.size(); ++i) {
    std::uint64_t found = 0;
    if (known[(hash + i) % known.size()].compare_exchange_strong(found, hash)) {
      char line[24];  // a stream would allocate
      syscall(SYS_write, file, line, std::snprintf(line, sizeof line, "%ld\n", number));
      return;
    }
    if (found == hash) return;
  }
}

/// Whether this call is the one. Only those count that the program makes, itself or in a library that it has called,
/// but for HDF5's beginning.
bool fails(const char* call, const char* path = nullptr)
{
  static std::atomic<long> n_calls{0};
  static const long last = std::atol(setting("TAMP_FAIL_AT"));
  static const char* const chosen = setting("TAMP_FAIL_CALL");
  static const bool lists_places = *setting("TAMP_FAIL_PLACES") != 0;
  if (!can_walk_stacks || std::strcmp(chosen, call) != 0 || (n_calls >= last && !lists_places)) return false;
  if (path != nullptr && std::strstr(path, setting("TAMP_FAIL_PATH")) == nullptr) return false;
  if (!is_time()) return false;
  const Stack stack;
  if (!stack.has(is_of_program) || stack.has(is_start_of_hdf5)) return false;
  const long number = ++n_calls;
  if (lists_places) note_place(stack, number);
  return number == last && note_failure(stack);
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

bool fails_of_memory(std::size_t n)
{
  static const auto least = static_cast<std::size_t>(std::atol(setting("TAMP_FAIL_SIZE")));
  if (n < least || !fails("malloc")) return false;
  errno = ENOMEM;
  return true;
}

template <class Function>
Function* next(Function*, const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier): glibc's own
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t n)
{
  return fails_of_memory(n) ? nullptr : __libc_malloc(n);
}

void* calloc(std::size_t n, std::size_t size)
{
  return fails_of_memory(n * size) ? nullptr : __libc_calloc(n, size);
}

void* realloc(void* old, std::size_t n)
{
  return fails_of_memory(n) ? nullptr : __libc_realloc(old, n);
}

void* aligned_alloc(std::size_t alignment, std::size_t n)
{
  return fails_of_memory(n) ? nullptr : __libc_memalign(alignment, n);
}

int posix_memalign(void** place, std::size_t alignment, std::size_t n)
{
  if (!fails_of_memory(n))
    *place = __libc_memalign(alignment, n);
  else
    return ENOMEM;
  return *place == nullptr ? ENOMEM : 0;
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

int fclose(std::FILE* stream)
{
  static auto* const real = next(&fclose, "fclose");
  const bool failed = fails_of_disk("fclose", fileno(stream));
  const int cause = errno;
  const int closed = real(stream);
  if (failed) errno = cause;
  return failed ? EOF : closed;
}

int ftruncate(int file, off_t n)
{
  static auto* const real = next(&ftruncate, "ftruncate");
  return fails_of_disk("ftruncate", file) ? -1 : real(file, n);
}

int ftruncate64(int file, off64_t n)
{
  static auto* const real = next(&ftruncate64, "ftruncate64");
  return fails_of_disk("ftruncate", file) ? -1 : real(file, n);
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

void exit(int code)
{
  static auto* const real = next(&exit, "exit");
  note_end("ended\n");
  real(code);
  abort();
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

herr_t H5Dclose(hid_t set)
{
  static auto* const real = next(&H5Dclose, "H5Dclose");
  const herr_t closed = real(set);
  return fails("H5Dclose") ? -1 : closed;
}

hid_t H5Dcreate2(hid_t at, const char* name, hid_t type, hid_t space, hid_t link, hid_t creation, hid_t access)
{
  static auto* const real = next(&H5Dcreate2, "H5Dcreate2");
  return fails("H5Dcreate2") ? -1 : real(at, name, type, space, link, creation, access);
}
}

namespace
{

/// As new does by itself, which asks again where the handler gives back.
[[noreturn]] void refuse_memory()
{
  if (const std::new_handler handler = std::get_new_handler(); handler != nullptr) handler();
  throw std::bad_alloc();
}

}  // namespace

// All other forms of new call these two.

void* operator new(std::size_t n)
{
  static auto* const real = next(static_cast<void* (*)(std::size_t)>(&operator new), "_Znwm");
  if (fails("new")) refuse_memory();
  return real(n);
}

void* operator new(std::size_t n, std::align_val_t alignment)
{
  static auto* const real =
      next(static_cast<void* (*)(std::size_t, std::align_val_t)>(&operator new), "_ZnwmSt11align_val_t");
  if (fails("new")) refuse_memory();
  return real(n, alignment);
}
