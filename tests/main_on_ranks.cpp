#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "runtime/ranks/communicator.hpp"

/// Alone, or on each of the ranks that mpiexec starts.
int main(int argc, char** argv)
{
  const tamp::runtime::MpiSession session(argc, argv);
  return Catch::Session().run(argc, argv);
}
