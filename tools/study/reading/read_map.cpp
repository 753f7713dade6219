#include <fmt/format.h>

#include <algorithm>

#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

/// Whether each of these methods sets a pointer.
bool is_set(StudyReader& in, const std::string& pointer, const std::vector<std::string>& methods)
{
  return std::all_of(methods.begin(), methods.end(), [&](const std::string& name) {
    const Method* method = in.find_method(name);
    if (method == nullptr) return true;  // told already
    const auto is_it = [&](const auto& setting) { return setting.first == pointer; };
    return std::any_of(in.study.settings.begin(), in.study.settings.end(), is_it) ||
           std::any_of(method->settings.begin(), method->settings.end(), is_it) ||
           std::any_of(method->sweep.begin(), method->sweep.end(),
                       [&](const Axis& axis) { return axis.pointer == pointer; });
  });
}

MapSheet map_sheet(StudyReader& in, JsonReader& reader)
{
  MapSheet sheet{reader.text("name", ""), in.names(reader, "methods"), in.pointer(reader, "rows"),
                 in.pointer(reader, "columns"), reader.optional_number("bound")};
  for (const std::string& name : sheet.methods) {
    if (in.find_method(name) != nullptr) continue;
    reader.add_problem("methods", fmt::format("\"{}\"", name), "expected names of methods");
  }
  for (const std::string& one : {sheet.rows, sheet.columns}) {
    if (!one.empty() && !is_set(in, one, sheet.methods)) {
      reader.add_problem(one == sheet.rows ? "rows" : "columns", one, "expected what its methods set");
    }
  }
  reader.finish();
  return sheet;
}

}  // namespace

void read_map(StudyReader& in)
{
  auto reader = in.root.optional_object("map");
  if (!reader) return;
  StudyMap map;
  map.quantity = reader->text("quantity", "");
  if (!in.find_quantity(map.quantity)) {
    reader->add_problem("quantity", fmt::format("\"{}\"", map.quantity), "expected the name of a quantity");
  }
  map.noisy = reader->number("noisy");
  map.blown = reader->number("blown");
  if (map.noisy >= map.blown) {
    reader->add_problem("blown", fmt::format("{}", map.blown), fmt::format("expected more than noisy, {}", map.noisy));
  }
  for (JsonReader& sheet : reader->objects("sheets")) map.sheets.push_back(map_sheet(in, sheet));
  reader->finish();
  in.study.map = std::move(map);
}

}  // namespace tamp::tools::study
