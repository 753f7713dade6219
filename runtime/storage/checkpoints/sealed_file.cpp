#include "runtime/storage/checkpoints/sealed_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <string>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/checksum.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

/// A file of bytes whose every failure is a FileError.
class ByteFile
{
 public:
  ByteFile(const std::filesystem::path& file, const char* mode) : file_(file)
  {
    expect_no_stream(file);
    stream_.reset(std::fopen(file.c_str(), mode));
    if (!stream_) fail();
  }

  std::size_t size()
  {
    if (std::fseek(stream_.get(), 0, SEEK_END) != 0) fail();
    return static_cast<std::size_t>(std::ftell(stream_.get()));
  }

  std::vector<std::byte> read(std::size_t first, std::size_t n)
  {
    std::vector<std::byte> bytes(n);
    if (std::fseek(stream_.get(), static_cast<long>(first), SEEK_SET) != 0) fail();
    if (std::fread(bytes.data(), 1, n, stream_.get()) != n) fail();
    return bytes;
  }

  void write_first(const std::string& bytes)
  {
    if (std::fseek(stream_.get(), 0, SEEK_SET) != 0) fail();
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail();
    if (std::fflush(stream_.get()) != 0) fail();
  }

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  [[noreturn]] void fail() const { throw FileError(file_.string(), std::strerror(errno)); }

  const std::filesystem::path& file_;
  std::unique_ptr<std::FILE, Close> stream_;
};

/// Length and checksum of what a seal is for.
struct Sealed {
  std::size_t n_bytes = 0;
  std::uint64_t sum = 0;

  std::string text() const
  {
    std::string block = fmt::format("TAMP sealed {} bytes with checksum {:016x}\n", n_bytes, sum);
    block.resize(seal_bytes, '\0');
    return block;
  }
};

/// The checksum of the checksums of pieces, which the ranks take in turn.
Sealed measured(const std::filesystem::path& file, const Communicator& communicator)
{
  constexpr std::size_t of_piece = 1 << 22;
  Sealed found;
  std::vector<std::uint64_t> sums;
  on_all_ranks(communicator, [&] {
    ByteFile bytes(file, "rb");
    found.n_bytes = bytes.size();
    if (found.n_bytes < seal_bytes) throw FileError(file.string(), fmt::format("is cut off at byte {}", found.n_bytes));
    sums.assign((found.n_bytes - seal_bytes + of_piece - 1) / of_piece, 0);
    const auto n_ranks = static_cast<std::size_t>(communicator.size());
    for (auto i = static_cast<std::size_t>(communicator.rank()); i < sums.size(); i += n_ranks) {
      const std::size_t first = seal_bytes + i * of_piece;
      sums[i] = checksum(bytes.read(first, std::min(of_piece, found.n_bytes - first)));
    }
  });
  sums = communicator.sum(std::move(sums));
  found.sum = checksum(std::as_bytes(std::span(sums)));
  return found;
}

/// How a file whose seal does not fit differs from what was sealed.
std::string difference(const std::string& seal, const Sealed& found)
{
  Sealed sealed;
  unsigned long long sum = 0;
  if (std::sscanf(seal.c_str(), "TAMP sealed %zu bytes with checksum %16llx", &sealed.n_bytes, &sum) != 2) {
    return "is not sealed, or its seal is damaged";
  }
  sealed.sum = sum;
  if (sealed.text() != seal) return "has a damaged seal";
  if (sealed.n_bytes != found.n_bytes) {
    return fmt::format("has {} bytes instead of {}", found.n_bytes, sealed.n_bytes);
  }
  return fmt::format("is damaged: its checksum is {:016x} instead of {:016x}", found.sum, sealed.sum);
}

}  // namespace

void seal(const std::filesystem::path& file, const Communicator& communicator)
{
  const Sealed sealed = measured(file, communicator);
  on_first_rank(communicator, [&] { ByteFile(file, "r+b").write_first(sealed.text()); });
}

void check_seal(const std::filesystem::path& file, const Communicator& communicator)
{
  const Sealed found = measured(file, communicator);
  on_first_rank(communicator, [&] {
    const std::vector<std::byte> block = ByteFile(file, "rb").read(0, seal_bytes);
    const std::string text(reinterpret_cast<const char*>(block.data()), block.size());
    if (text != found.text()) throw FileError(file.string(), difference(text, found));
  });
}

}  // namespace tamp::runtime
