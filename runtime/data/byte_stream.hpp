#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace tamp::runtime
{

/// Values one after the other as bytes, to be read back in the same order by the same program.
class ByteWriter
{
 public:
  template <class T>
  void add(const T& value)
  {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof(T));
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class ByteReader
{
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class T>
  void read(T& value)
  {
    std::memcpy(static_cast<void*>(&value), left_.data(), sizeof(T));
    left_ = left_.subspan(sizeof(T));
  }
  std::span<const std::byte> rest() const { return left_; }

 private:
  std::span<const std::byte> left_;
};

}  // namespace tamp::runtime
