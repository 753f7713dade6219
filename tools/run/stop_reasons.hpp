#pragma once

#include <array>
#include <csignal>

namespace tamp::tools
{

/// Requests that one rank may make of all with a step, as bits.
constexpr unsigned checkpoint_wanted = 1;
constexpr unsigned end_as_output_has_failed = 1U << 1;

/// Why a run stops early, and with the exit code of which signal.
struct StopReason {
  unsigned request;
  int signal;
  const char* words;
};
constexpr StopReason wall_limit_reached{1U << 2, SIGTERM, "stopped at its wall limit"};
constexpr std::array stop_reasons{wall_limit_reached, StopReason{1U << 3, SIGTERM, "stopped by SIGTERM"},
                                  StopReason{1U << 4, SIGINT, "stopped by SIGINT"},
                                  StopReason{1U << 5, SIGHUP, "stopped by SIGHUP, as its terminal was lost"},
                                  StopReason{1U << 6, SIGXCPU, "stopped by SIGXCPU, at its limit of processor time"}};

/// The reason that was asked for; null if none.
inline const StopReason* stop_reason(unsigned requests)
{
  for (const StopReason& reason : stop_reasons) {
    if ((requests & reason.request) != 0) return &reason;
  }
  return nullptr;
}

}  // namespace tamp::tools
