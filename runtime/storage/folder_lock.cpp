#include "runtime/storage/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <sstream>
#include <system_error>
#include <utility>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

namespace
{

/// Begins the names of the files that read the clock.
constexpr const char* clock_prefix = ".run.lock.";
constexpr std::chrono::seconds touched_every{10};
/// [s]
constexpr double stale_after = 60;

/// A descriptor that is closed in the end, and with it the flock on it released.
class Descriptor
{
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor()
  {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(Descriptor&& other) noexcept : descriptor_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool good() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

std::string host_name()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string text_of_own_lock()
{
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("host {}\nprocess {}\nsince {:%Y-%m-%dT%H:%M:%SZ}\n", host_name(), getpid(), fmt::gmtime(now));
}

/// The time by the clock of the folder's disk, which may be another machine's.
std::time_t now_in(const std::filesystem::path& folder)
{
  std::string name = (folder / (std::string(clock_prefix) + "XXXXXX")).string();
  const Descriptor file(mkstemp(name.data()));
  struct stat made {
  };
  if (!file.good() || fstat(file.get(), &made) != 0) return std::time(nullptr);
  ::unlink(name.c_str());
  return made.st_mtime;
}

/// The lock that is there, open; not good where there is none. Throws FileError for what is no file, which is not
/// opened: a pipe would wait for a writer.
Descriptor existing_lock(const std::filesystem::path& file)
{
  struct stat found {
  };
  if (lstat(file.c_str(), &found) != 0) {
    if (errno != ENOENT) throw FileError(file.string(), std::strerror(errno));
    return Descriptor(-1);
  }
  if (!S_ISREG(found.st_mode)) throw FileError(file.string(), "is no file, as a lock is; remove it");
  Descriptor lock(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!lock.good() && errno != ENOENT) throw FileError(file.string(), std::strerror(errno));
  return lock;
}

/// The holder that a lock names. Lines that are missing, as it was not written to its end, stay empty.
LockHolder holder_in(const std::filesystem::path& folder, const Descriptor& lock)
{
  LockHolder holder;
  std::array<char, 1024> text{};
  const ssize_t size = ::pread(lock.get(), text.data(), text.size(), 0);
  std::istringstream stream(std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))));
  for (std::string word; stream >> word;) {
    if (word == "host") stream >> holder.host;
    if (word == "process") stream >> holder.process;
    if (word == "since") stream >> holder.since;
  }
  struct stat found {
  };
  if (fstat(lock.get(), &found) == 0) holder.untouched = std::difftime(now_in(folder), found.st_mtime);
  return holder;
}

/// Whether the process that wrote a lock is known to have ended. Where the file system has flock, its flock tells;
/// otherwise, whether there is such a process.
bool has_ended(const LockHolder& holder, int descriptor)
{
  if (holder.host != host_name()) return false;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  return kill(static_cast<pid_t>(holder.process), 0) != 0 && errno == ESRCH;
}

}  // namespace

bool LockHolder::is_silent() const
{
  return std::abs(untouched) >= stale_after;
}

std::string LockHolder::description() const
{
  const std::string heard = untouched > -stale_after
                                ? fmt::format("last heard of {:.0f} s ago", std::max(untouched, 0.0))
                                : fmt::format("its lock dated {:.0f} s ahead of now", -untouched);
  return fmt::format("process {} on {} since {}, {}", process, host.empty() ? "an unknown machine" : host,
                     since.empty() ? "an unknown time" : since, heard);
}

bool FolderLock::makes(const std::filesystem::path& file)
{
  const std::string name = file.filename().string();
  return name == file_name || name.starts_with(clock_prefix);
}

FolderLock::FolderLock(const std::filesystem::path& folder) : folder_(folder), file_(folder / file_name)
{
  take();
  try {
    toucher_ = std::thread([this] { touch_until_stopped(); });
  } catch (const std::system_error& error) {
    ::unlink(file_.c_str());
    ::close(descriptor_);
    throw FileError(file_.string(), fmt::format("no thread can be started that touches it: {}", error.what()));
  }
}

FolderLock::~FolderLock()
{
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  stop_.notify_all();
  toucher_.join();
  if (is_own()) ::unlink(file_.c_str());
  ::close(descriptor_);
}

void FolderLock::take()
{
  // Who looks at a lock and takes it over does so alone, as far as the file system knows flock.
  const Descriptor locked_folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!locked_folder.good()) throw FileError(folder_.string(), std::strerror(errno));
  ::flock(locked_folder.get(), LOCK_EX);

  if (const Descriptor old = existing_lock(file_); old.good()) {
    former_ = holder_in(folder_, old);
    if (!has_ended(*former_, old.get()) && !former_->is_silent()) throw FolderInUse(*former_);
    ::unlink(file_.c_str());
  }
  const std::string text = text_of_own_lock();
  errno = ENOSPC;  // the cause of a short write
  Descriptor own(::open(file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (!own.good() && errno == EEXIST) throw FolderInUse(holder_in(folder_, existing_lock(file_)));
  if (!own.good() || ::write(own.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    const int cause = errno;
    if (own.good()) ::unlink(file_.c_str());
    throw FileError(file_.string(), std::strerror(cause));
  }
  ::flock(own.get(), LOCK_EX | LOCK_NB);
  descriptor_ = own.release();
}

bool FolderLock::is_own() const
{
  struct stat own {
  }, there{};
  return fstat(descriptor_, &own) == 0 && stat(file_.c_str(), &there) == 0 && own.st_ino == there.st_ino &&
         own.st_dev == there.st_dev;
}

void FolderLock::touch_until_stopped()
{
  std::unique_lock lock(mutex_);
  while (!stop_.wait_for(lock, touched_every, [this] { return stopped_; })) {
    if (is_own()) futimens(descriptor_, nullptr);
  }
}

}  // namespace tamp::runtime
