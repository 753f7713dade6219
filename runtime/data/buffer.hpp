#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <utility>

#include "runtime/data/memory_ledger.hpp"

namespace tamp::runtime
{

/// Bytes of field data on a cache-line boundary, zero where never written, reported to the ledger.
class Buffer
{
 public:
  static constexpr std::size_t alignment = 64;

  Buffer() = default;
  explicit Buffer(LedgerEntry& entry) : entry_(&entry) {}
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept
  {
    swap(other);
    return *this;
  }
  ~Buffer() { resize_storage(0); }

  std::byte* data() const { return data_; }
  std::size_t capacity() const { return capacity_; }

  /// Makes room for `bytes`, keeping what is there. Grows by a sixteenth at least, so that slow growth stays
  /// cheap and takes little more memory than was forecast.
  void reserve(std::size_t bytes)
  {
    if (bytes > capacity_) resize_storage(capacity_ == 0 ? bytes : std::max(bytes, capacity_ + capacity_ / 16));
  }

  /// Makes room for `bytes`, as above, or gives back what is there beyond them where that is more than three quarters:
  /// of what comes and goes, such as particles that cross a patch.
  void fit(std::size_t bytes)
  {
    if (bytes < capacity_ / 4) return resize_storage(bytes + bytes / 16);
    reserve(bytes);
  }

  void release() { resize_storage(0); }

  void swap(Buffer& other) noexcept
  {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    std::swap(entry_, other.entry_);
  }

 private:
  void resize_storage(std::size_t bytes)
  {
    std::byte* fresh = nullptr;
    if (bytes > 0) {
      fresh = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{alignment}));
      if (capacity_ > 0) std::memcpy(fresh, data_, std::min(capacity_, bytes));
      if (bytes > capacity_) std::memset(fresh + capacity_, 0, bytes - capacity_);
    }
    if (data_ != nullptr) ::operator delete (data_, std::align_val_t{alignment});
    if (entry_ != nullptr) entry_->add(static_cast<std::ptrdiff_t>(bytes) - static_cast<std::ptrdiff_t>(capacity_));
    data_ = fresh;
    capacity_ = bytes;
  }

  std::byte* data_ = nullptr;
  std::size_t capacity_ = 0;
  LedgerEntry* entry_ = nullptr;
};

}  // namespace tamp::runtime
