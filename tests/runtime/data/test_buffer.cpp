#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "runtime/data/buffer.hpp"

namespace tamp::runtime::test_buffer
{

TEST_CASE("a buffer gives back what it no longer needs, keeps what is in use, and tells the ledger")
{
  MemoryLedger ledger;
  Buffer buffer(ledger.entry("particles"));
  buffer.fit(1000);
  std::memset(buffer.data(), 7, 1000);

  buffer.fit(300);
  CHECK(buffer.capacity() == 1000);  // may be wanted again

  buffer.fit(160);
  CHECK(buffer.capacity() == 170);
  CHECK(std::count(buffer.data(), buffer.data() + 160, std::byte{7}) == 160);
  CHECK(ledger.total().current() == 170);
  CHECK(ledger.total().peak() == 1000);

  buffer.fit(0);
  CHECK(buffer.capacity() == 0);
  CHECK(ledger.total().current() == 0);
}

}  // namespace tamp::runtime::test_buffer
