#pragma once

#include <string>

namespace tamp::tools
{

/// The commit of the program's sources as it was built, with a + if they had been changed since; empty if it was built
/// without git.
std::string commit();

}  // namespace tamp::tools
