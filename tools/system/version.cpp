#include "tools/system/version.hpp"

#include <fmt/core.h>
#include <hdf5.h>
#include <mpi.h>
#include <tbb/version.h>
#include <xxhash.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>

#include "tools/system/commit.hpp"

namespace tamp::tools
{

namespace
{

std::string hdf5_version()
{
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

/// The first words of what the library says of itself, such as "Open MPI v4.1.4".
std::string mpi_version()
{
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data());
  return all.substr(0, all.find(','));
}

std::string compiler()
{
#ifdef __clang__
  return fmt::format("clang {}", __clang_version__);
#else
  return fmt::format("gcc {}", __VERSION__);
#endif
}

}  // namespace

std::string version()
{
  return TAMP_VERSION;
}

nlohmann::ordered_json build_json()
{
  return {{"version", version()},
          {"commit", commit()},
          {"build", TAMP_BUILD_TYPE},
          {"architecture", TAMP_ARCH},
          {"compiler", compiler()}};
}

std::string version_text()
{
  return fmt::format(
      "tamp {}\n"
      "build     {} for {}\n"
      "compiler  {}\n"
      "oneTBB    {}\n"
      "Eigen     {}.{}.{}\n"
      "HDF5      {}\n"
      "MPI       {}\n"
      "fmt       {}.{}.{}\n"
      "json      {}.{}.{}\n"
      "CLI11     {}\n"
      "xxHash    {}.{}.{}",
      version(), TAMP_BUILD_TYPE, TAMP_ARCH, compiler(), TBB_runtime_version(), EIGEN_WORLD_VERSION,
      EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, hdf5_version(), mpi_version(), FMT_VERSION / 10000,
      FMT_VERSION / 100 % 100, FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
      NLOHMANN_JSON_VERSION_PATCH, CLI11_VERSION, XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE);
}

}  // namespace tamp::tools
