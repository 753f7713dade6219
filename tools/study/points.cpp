#include "tools/study/points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tamp::tools::study
{

namespace
{

/// All combinations of the axes' values, the last axis fastest.
std::vector<Settings> combinations(const std::vector<Axis>& axes)
{
  std::vector<Settings> all{{}};
  for (const Axis& axis : axes) {
    std::vector<Settings> longer;
    for (const Settings& settings : all) {
      for (const Json& value : axis.values) longer.push_back(merged(settings, {{axis.pointer, value}}));
    }
    all = std::move(longer);
  }
  return all;
}

class PointList
{
 public:
  explicit PointList(const Study& study) : study_(study) {}

  void add(Point::Role role, const std::string& method, const std::string& label, const Settings& settings,
           const Settings& own = {})
  {
    points_.push_back({static_cast<int>(points_.size()) + 1, role, method, label, settings, own});
  }

  void add_methods()
  {
    for (const Method& method : study_.methods) {
      const Settings common = merged(study_.settings, method.settings);
      std::vector<Settings> all = method.listed;
      if (!method.sweep.empty() || all.empty()) {
        const std::vector<Settings> swept = combinations(method.sweep);
        all.insert(all.begin(), swept.begin(), swept.end());
      }
      for (const Settings& own : all)
        add(Point::Role::chart, method.name, settings_text(own), merged(common, own), own);
    }
  }

  void add_references()
  {
    if (!study_.reference->of_each_method) return add_reference(study_.settings, "");
    for (const Method& method : study_.methods) add_reference(merged(study_.settings, method.settings), method.name);
  }

  void add_reference(const Settings& settings, const std::string& of_method)
  {
    const ReferenceRuns& reference = *study_.reference;
    const Settings common = merged(settings, reference.settings);
    std::vector<Axis> axes;
    if (!reference.refinement.values.empty()) axes.push_back(reference.refinement);
    Settings finest = common;
    for (const Settings& own : combinations(axes)) {
      finest = merged(common, own);
      add_reference_point(Point::Role::reference, of_method, finest, own);
    }
    for (const Settings& form : reference.beside) {
      add_reference_point(Point::Role::witness, of_method, merged(finest, form), form);
    }
  }

  void add_reference_point(Point::Role role, const std::string& of_method, const Settings& settings,
                           const Settings& own)
  {
    const std::string prefix = of_method.empty() ? "" : of_method + ", ";
    add(role, reference_name, prefix + settings_text(own), settings, own);
    points_.back().reference_of = of_method;
  }

  void add_budget()
  {
    for (const BudgetBase& base : study_.budget->bases) {
      add(Point::Role::variation, budget_name, base.name, base_settings(study_, base));
      for (const BudgetPart& part : study_.budget->parts) {
        for (const Settings& variation : part.variations) {
          add(Point::Role::variation, budget_name, base.name + ", " + settings_text(variation),
              varied_settings(study_, base, variation));
        }
      }
    }
  }

  std::vector<Point> points() { return std::move(points_); }

 private:
  const Study& study_;
  std::vector<Point> points_;
};

}  // namespace

Settings merged(Settings settings, const Settings& others)
{
  for (const auto& other : others) {
    const auto same =
        std::find_if(settings.begin(), settings.end(), [&](const auto& s) { return s.first == other.first; });
    if (same != settings.end()) {
      same->second = other.second;
    } else {
      settings.push_back(other);
    }
  }
  return settings;
}

Json Point::setting(const std::string& pointer) const
{
  const auto at = std::find_if(settings.begin(), settings.end(), [&](const auto& s) { return s.first == pointer; });
  return at == settings.end() ? Json(nullptr) : at->second;
}

std::vector<Point> points_of(const Study& study)
{
  PointList list(study);
  list.add_methods();
  if (study.reference) list.add_references();
  if (study.budget) list.add_budget();
  return list.points();
}

Settings base_settings(const Study& study, const BudgetBase& base)
{
  return merged(study.settings, base.settings);
}

Settings varied_settings(const Study& study, const BudgetBase& base, const Settings& variation)
{
  return merged(base_settings(study, base), variation);
}

bool is_pointer(const std::string& text)
{
  try {
    return !JsonPointer(text).empty();
  } catch (const Json::exception&) {
    return false;
  }
}

std::string settings_text(const Settings& settings)
{
  std::vector<std::string> texts;
  for (const auto& [pointer, value] : settings) {
    const std::string name = pointer_name(pointer);
    const auto is_alike = [&](const auto& other) { return pointer_name(other.first) == name; };
    const bool is_unique = std::count_if(settings.begin(), settings.end(), is_alike) == 1;
    texts.push_back((is_unique ? name : pointer) + " " + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string pointer_name(const std::string& pointer)
{
  std::string name = JsonPointer(pointer).back();
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace tamp::tools::study
