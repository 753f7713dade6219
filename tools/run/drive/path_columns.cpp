#include "tools/run/drive/path_columns.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

/// The name without its letter is one of a component, such as 12; of stress only of i <= j.
bool is_path_column(const std::string& name)
{
  if (name == "time") return true;
  if (name.size() != 3 || (name[0] != 'F' && name[0] != 'S')) return false;
  const auto is_axis = [](char axis) { return axis >= '1' && axis <= '3'; };
  return is_axis(name[1]) && is_axis(name[2]) && (name[0] == 'F' || name[1] <= name[2]);
}

class ColumnChecks
{
 public:
  ColumnChecks(const std::vector<std::string>& columns, const std::string& place) : columns_(columns), place_(place) {}

  void check_names()
  {
    for (auto at = columns_.begin(); at != columns_.end(); ++at) {
      if (!is_path_column(*at)) {
        add(fmt::format("column \"{}\"", *at), "time, F11 to F33, S11, S22, S33, S12, S13 or S23");
      } else if (std::find(columns_.begin(), at, *at) != at) {
        add(fmt::format("column {} twice", *at), "it once");
      }
    }
    if (!has("time")) add("no column time", "one");
  }

  /// Whether it is stress that is prescribed.
  bool is_controlled(int i, int j)
  {
    const std::string f = fmt::format("F{}{}", i + 1, j + 1), s = fmt::format("S{}{}", i + 1, j + 1);
    if (has(f) && has(s)) add(fmt::format("columns {} and {}", f, s), "one of them");
    if (i == j && !has(f) && !has(s)) add(fmt::format("neither {} nor {}", f, s), "one of them");
    return has(s);
  }

  void throw_problems()
  {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }

 private:
  bool has(const std::string& name) const
  {
    return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
  }
  void add(const std::string& found, const std::string& expected)
  {
    problems_.push_back({place_, found, "expected " + expected});
  }

  const std::vector<std::string>& columns_;
  const std::string& place_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<StressControl> stress_controls(const std::vector<std::string>& columns, const std::string& place)
{
  ColumnChecks checks(columns, place);
  checks.check_names();
  std::vector<StressControl> controls;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      if (checks.is_controlled(i, j)) controls.push_back(component_control(i, j));
    }
  }
  checks.throw_problems();
  return controls;
}

}  // namespace tamp::tools
