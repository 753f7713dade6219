#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "components/materials/tabular_cap.hpp"
#include "tests/components/materials/one_particle.hpp"

/// The concrete sand of inputs/materials/concrete-sand, for tests.
namespace concrete_sand
{

using Columns = std::vector<std::vector<double>>;

inline Columns columns(const std::string& name)
{
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();
  std::ifstream file(root / "inputs/materials/concrete-sand" / name);
  if (!file) throw std::runtime_error("no " + name);
  Columns table;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line.find('[') != std::string::npos) continue;
    std::stringstream cells(line);
    std::string cell;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (table.size() <= i) table.emplace_back();
      table[i].push_back(std::stod(cell));
    }
  }
  return table;
}

inline tamp::components::PiecewiseLinear curve(const std::string& name)
{
  const Columns table = columns(name);
  return {table[0], table[1]};
}

inline const tamp::components::UnloadingTable& unloading()
{
  static const tamp::components::UnloadingTable table = [] {
    const Columns rows = columns("unloading.csv");
    return tamp::components::UnloadingTable(rows[0], rows[1], rows[2]);
  }();
  return table;
}

/// As the published code reads it: the numbers as sqrt(J2).
inline tamp::components::YieldSurface yield_surface()
{
  const Columns rows = columns("yield_sqrt_J2.csv");
  return {rows[0], rows[1], 0.7};
}

inline tamp::components::TabularCap sand(tamp::components::ElasticUpdate form)
{
  using namespace tamp::components;
  const PiecewiseLinear crush = form == ElasticUpdate::state
                                    ? consistent_crush_curve(unloading(), curve("hydrostat.csv"))
                                    : curve("crush_curve.csv");
  return TabularCap({0.189, form, unloading(), crush, yield_surface()});
}

template <int D>
using Sample = tamp::test::OneParticle<D, tamp::components::TabularCap>;

}  // namespace concrete_sand
