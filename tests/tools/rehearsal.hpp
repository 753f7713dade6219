#pragma once

/// Sanitizers make a step some thirty times as long. There whole scenes, studies and catalogues are rehearsed: each of
/// their runs takes a few steps, and what they come to is judged in other presets.
namespace tamp::test
{

inline constexpr bool is_rehearsal = TAMP_SANITIZED;
/// For `tamp study`, `tamp verify` and `tamp stability`.
inline constexpr const char* rehearsed = is_rehearsal ? " --steps 20" : "";
/// Steps of a test that takes `whole` steps when it is not a rehearsal.
constexpr int n_steps_of(int whole)
{
  return is_rehearsal ? (whole + 9) / 10 : whole;
}
/// End of a test that runs a scene to the time `whole` when it is not a rehearsal [s].
constexpr double end_of(double whole)
{
  return is_rehearsal ? whole / 10 : whole;
}

}  // namespace tamp::test
