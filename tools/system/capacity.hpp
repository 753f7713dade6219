#pragma once

#include <filesystem>
#include <string>

namespace tamp::tools
{

/// The memory that a program may still take here [bytes], and what bounds it.
struct FreeMemory {
  double bytes;
  /// The bound in words, such as "this machine has free".
  std::string why;
};

/// The least of what the machine has free, the control group leaves, and, times the `n_ranks` that share the work, the
/// limits of the process (ulimit) leave.
FreeMemory free_memory(int n_ranks = 1);

/// Resident memory of this process [bytes].
double resident_bytes();

/// Free space on the disk of a folder, which need not exist yet [bytes].
double free_disk(const std::filesystem::path& folder);

/// A size in words, such as 1.2 GiB.
std::string in_bytes(double bytes);

/// Has large memory given back to the system as it is freed, so that what was gathered for an output leaves no gaps
/// that nothing fills. For the C library of GNU; elsewhere nothing.
void give_back_freed_memory();

}  // namespace tamp::tools
