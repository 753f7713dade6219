#include "tools/drive/columns.hpp"

#include <array>
#include <cmath>

#include "components/portable_math.hpp"

namespace tamp::tools
{

namespace
{

/// Voigt's order: s11, s22, s33, s23, s13, s12, where our tensors have xx, yy, zz, xy, yz, xz.
constexpr std::array<int, 6> voigt{0, 1, 2, 4, 5, 3};

bool in_range(const components::TabularCap& sand, const components::CapState& state)
{
  return std::visit(
      [&](const auto& model) { return model.in_range(state.elastic_volumetric, state.plastic_volumetric); },
      sand.parameters().modulus);
}

}  // namespace

std::vector<std::string> drive_columns()
{
  return {"time[s]", "F11",     "F12",     "F13",         "F21",      "F22",          "F23",
          "F31",     "F32",     "F33",     "strain_v[-]", "p[Pa]",    "q[Pa]",        "s11[Pa]",
          "s22[Pa]", "s33[Pa]", "s23[Pa]", "s13[Pa]",     "s12[Pa]",  "elastic_v[-]", "plastic_v[-]",
          "cap[Pa]", "K[Pa]",   "G[Pa]",   "substeps",    "in_range", "outside[-]",   "plastic_work[J/m3]"};
}

std::vector<double> drive_values(const tasks::MaterialModel& material, double time, const MaterialPoint& point)
{
  std::vector<double> values{time};
  for (int i = 0; i < 9; ++i) values.push_back(point.deformation_gradient(i / 3, i % 3));
  values.insert(values.end(), {-portable::log(point.volume), point.pressure(), point.equivalent_stress()});
  for (const int i : voigt) values.push_back(point.stress[i]);

  const components::CapState& state = point.state;
  double cap = 0, range = 1, beyond = 0;
  if (const auto* sand = std::get_if<components::TabularCap>(&material)) {
    cap = sand->crush_pressure(state.plastic_volumetric);
    range = in_range(*sand, state) ? 1 : 0;
    beyond = outside(*sand, point);
  }
  const auto n_substeps = static_cast<double>(point.last_update.substeps);
  values.insert(values.end(), {state.elastic_volumetric, state.plastic_volumetric, cap, point.bulk_modulus,
                               point.shear_modulus, n_substeps, range, beyond, point.plastic_work});
  for (double& value : values) value += 0.0;  // no minus zero
  return values;
}

}  // namespace tamp::tools
