#pragma once

#include <string>

#include "tests/tools/temporary_folder.hpp"
#include "tools/system/errors.hpp"

namespace tamp::test
{

/// Problems that `read` reports, a line each, without the folder's path; empty if there are none.
template <class Read>
std::string problems_of_reading(const TemporaryFolder& folder, Read read)
{
  try {
    read();
    return "";
  } catch (const tools::InputError& error) {
    std::string text = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }
}

}  // namespace tamp::test
