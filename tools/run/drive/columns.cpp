#include "tools/run/drive/columns.hpp"

#include <fmt/core.h>

#include <array>

#include "components/materials/state_columns.hpp"
#include "components/portable_math.hpp"

namespace tamp::tools
{

namespace
{

using components::Shown;

/// Voigt's order: s11, s22, s33, s23, s13, s12, where our tensors have xx, yy, zz, xy, yz, xz.
constexpr std::array<int, 6> voigt{0, 1, 2, 4, 5, 3};

/// Its name with its unit; volumetric strains are called as strain_v is.
template <class Model>
std::string header_of(const components::StateColumn<Model>& column)
{
  constexpr std::string_view ending = "_volumetric";
  std::string name(column.name);
  if (name.ends_with(ending)) name.replace(name.size() - ending.size(), ending.size(), "_v");
  return column.unit.empty() ? name : fmt::format("{}[{}]", name, column.unit);
}

void add_names(const tasks::MaterialModel& material, Shown shown, std::vector<std::string>& names)
{
  std::visit(
      [&]<class Model>(const Model& model) {
        for (const auto& column : components::state_columns<Model>()) {
          if (column.shown == shown) names.push_back(header_of(column));
        }
        if (shown == Shown::by_drive && components::keeps_gaps(model)) names.push_back("opening[-]");
      },
      material);
}

void add_values(const tasks::MaterialModel& material, Shown shown, const MaterialPoint& point,
                std::vector<double>& values)
{
  std::visit(
      [&]<class Model>(const Model& model) {
        const auto& state = std::any_cast<const typename Model::State&>(point.state);
        for (const auto& column : components::state_columns<Model>()) {
          if (column.shown == shown) values.push_back(column.value(model, state, point.invariants()));
        }
        if (shown == Shown::by_drive && components::keeps_gaps(model)) values.push_back(point.opening);
      },
      material);
}

}  // namespace

std::vector<std::string> drive_columns(const tasks::MaterialModel& material)
{
  std::vector<std::string> names{"time[s]", "F11",     "F12",     "F13",         "F21",    "F22",   "F23",
                                 "F31",     "F32",     "F33",     "strain_v[-]", "p[Pa]",  "q[Pa]", "s11[Pa]",
                                 "s22[Pa]", "s33[Pa]", "s23[Pa]", "s13[Pa]",     "s12[Pa]"};
  add_names(material, Shown::everywhere, names);
  names.insert(names.end(), {"K[Pa]", "G[Pa]", "substeps"});
  add_names(material, Shown::by_drive, names);
  names.push_back("plastic_work[J/m3]");
  return names;
}

std::vector<double> drive_values(const tasks::MaterialModel& material, double time, const MaterialPoint& point)
{
  const components::Invariants stress = point.invariants();
  std::vector<double> values{time};
  for (int i = 0; i < 9; ++i) values.push_back(point.deformation_gradient(i / 3, i % 3));
  values.insert(values.end(), {-portable::log(point.volume), stress.pressure, stress.q()});
  for (const int i : voigt) values.push_back(point.stress[i]);
  add_values(material, Shown::everywhere, point, values);
  values.insert(values.end(),
                {point.bulk_modulus, point.shear_modulus, static_cast<double>(point.last_update.substeps)});
  add_values(material, Shown::by_drive, point, values);
  values.push_back(point.plastic_work);
  for (double& value : values) value += 0.0;  // no minus zero
  return values;
}

}  // namespace tamp::tools
