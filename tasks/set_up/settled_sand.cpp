#include "tasks/set_up/settled_sand.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "components/errors.hpp"
#include "components/materials/invariants.hpp"
#include "tasks/set_up/body_sites.hpp"

namespace tamp::tasks
{

namespace
{

using components::BadValue;
using components::LayerColumn;

const components::TabularCap& sand_of(const Scene& scene, const SceneBody& body)
{
  const SceneMaterial& material = scene.materials[static_cast<std::size_t>(body.material)];
  const auto* sand = std::get_if<components::TabularCap>(&material.model);
  if (!sand) throw BadValue("material \"" + material.name + "\"", "a material of type tabular_cap");
  return *sand;
}

/// Where particles stand along an axis, and between which walls.
template <int D>
LayerColumn column_of(const Scene& scene, int particles_per_axis, const std::vector<Vector<D>>& sites, std::size_t k)
{
  const runtime::Grid& grid = scene.grid;
  const int axis = static_cast<int>(k), n_cells = grid.n_cells[k];
  LayerColumn column;
  column.spacing = grid.cell_size / particles_per_axis;
  column.nodes = {Vector<1>(grid.coordinate(axis, -1)), grid.cell_size, {n_cells + 3}, {1}};
  std::vector<double>& layers = column.layers;
  for (const Vector<D>& x : sites) layers.push_back(x[axis]);
  std::sort(layers.begin(), layers.end());
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  const double reach = 0.75 * column.spacing;
  const bool at_lower = layers.front() - grid.coordinate(axis, 0) < reach;
  const bool at_upper = grid.coordinate(axis, n_cells) - layers.back() < reach;
  // Sand that fills a periodic axis goes on beyond both ends, as between mirrors.
  column.lower_wall =
      grid.periodic[k] ? at_lower && at_upper : at_lower && components::traits_of(scene.faces[k][0]).is_wall();
  column.upper_wall =
      grid.periodic[k] ? at_lower && at_upper : at_upper && components::traits_of(scene.faces[k][1]).is_wall();
  return column;
}

void check_has_no_gap(const LayerColumn& column, std::size_t k)
{
  const std::vector<double>& layers = column.layers;
  const double extent = static_cast<double>(layers.size() - 1) * column.spacing;
  if (std::abs(layers.back() - layers.front() - extent) < 0.5 * column.spacing) return;
  throw BadValue(fmt::format("a region with a gap along {}", "xyz"[k]), "a box");
}

/// The axis with a floor and a free top; the others must have two walls.
template <int D>
std::size_t vertical_axis(const std::array<LayerColumn, std::size_t{D}>& columns)
{
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < D; ++k) {
    if (!(columns[k].lower_wall && columns[k].upper_wall)) open.push_back(k);
  }
  if (open.size() == 1 && (columns[open[0]].lower_wall || columns[open[0]].upper_wall)) return open[0];
  std::string axes;
  for (const std::size_t k : open) axes += "xyz"[k];
  throw BadValue(open.empty() ? "a body between walls along every axis" : "a body not between walls along " + axes,
                 "sides and floor on walls, and one free face");
}

/// The component along each axis of gravity and what rest in the turning frame feels.
template <int D>
std::array<components::LinearForce, std::size_t{D}> body_force(const Scene& scene)
{
  std::array<components::LinearForce, std::size_t{D}> force;
  for (std::size_t k = 0; k < D; ++k) {
    force[k] = {scene.gravity[k], 0};
    if (!scene.grid.periodic[k] || scene.gravity[k] == 0) continue;
    throw BadValue(fmt::format("gravity along {}, which is periodic", "xyz"[k]), "none along an axis without walls");
  }
  if (!scene.centrifuge) return force;
  const Matrix<3> gradient = scene.centrifuge->gradient_by_position(0);
  const Matrix<3> across = gradient - Matrix<3>(gradient.diagonal().asDiagonal());
  if (across.cwiseAbs().maxCoeff() > 1e-14 * gradient.cwiseAbs().maxCoeff()) {
    throw BadValue("a centrifugal force of which a component changes across its axis",
                   "a centrifuge of constant speed about an axis along x, y or z");
  }
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    force[k].slope = gradient(axis, axis);
    force[k].value -= gradient(axis, axis) * scene.centrifuge->centre()[axis];
  }
  return force;
}

}  // namespace

template <int D>
SettledSand<D>::SettledSand(const Scene& scene, const SceneBody& body) : sand_(&sand_of(scene, body))
{
  const std::vector<Vector<D>> sites = sites_of<D>(scene, body);
  if (sites.empty()) throw BadValue("a region without particles", "a box");
  const int particles_per_axis = scene.particles_per_axis_of(body.material);
  std::size_t n_in_box = 1;
  for (std::size_t k = 0; k < D; ++k) {
    columns_[k] = column_of<D>(scene, particles_per_axis, sites, k);
    check_has_no_gap(columns_[k], k);
    n_in_box *= columns_[k].layers.size();
  }
  if (sites.size() != n_in_box) throw BadValue("a region that is no box along the axes", "a box");
  vertical_ = vertical_axis<D>(columns_);
  const auto force = body_force<D>(scene);
  const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
  for (std::size_t k = 0; k < D; ++k) {
    along_[k] = components::settled_stress(scene.interpolator, particles_per_axis, columns_[k], density, force[k]);
  }
}

template <int D>
SymmetricTensor<D> SettledSand<D>::stress(const std::array<std::size_t, std::size_t{D}>& layer) const
{
  const double nu = sand_->poisson_ratio();
  const double vertical = along_[vertical_][layer[vertical_]];
  SymmetricTensor<D> stress = isotropic<n_symmetric<D>>(nu / (1 - nu) * vertical);
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    stress[axis] = k == vertical_ ? vertical : stress[axis] + along_[k][layer[k]];
  }
  return stress;
}

template <int D>
typename SettledSand<D>::Particle SettledSand<D>::settled(const SymmetricTensor<D>& stress) const
{
  const components::Invariants now = components::invariants(stress);
  const double plastic = sand_->plastic_volumetric_at_crush(-stress[static_cast<Eigen::Index>(vertical_)]);
  const double limit = sand_->parameters().yield.limit(now.pressure, sand_->crush_pressure(plastic));
  if (!(now.sqrt_j2() <= limit)) {
    throw BadValue(fmt::format("q = {:.4g} Pa at p = {:.4g} Pa", now.q(), now.pressure),
                   fmt::format("at most the sand's strength there, q = {:.4g} Pa", std::sqrt(3.0) * limit));
  }
  return {stress, sand_->state_at_pressure(now.pressure, plastic)};
}

template <int D>
typename SettledSand<D>::Particle SettledSand<D>::at(const Vector<D>& x) const
{
  std::array<std::size_t, std::size_t{D}> layer;
  for (std::size_t k = 0; k < D; ++k) {
    const LayerColumn& column = columns_[k];
    layer[k] = static_cast<std::size_t>(
        std::lround((x[static_cast<Eigen::Index>(k)] - column.layers.front()) / column.spacing));
  }
  try {
    return settled(stress(layer));
  } catch (const BadValue& bad) {
    throw BadValue(fmt::format("{} at [{}]", bad.found, fmt::join(x.data(), x.data() + D, ", ")), bad.expected);
  }
}

template <int D>
double SettledSand<D>::greatest_bulk_modulus() const
{
  std::array<std::size_t, std::size_t{D}> layer;
  for (std::size_t k = 0; k < D; ++k) {
    layer[k] = static_cast<std::size_t>(std::min_element(along_[k].begin(), along_[k].end()) - along_[k].begin());
  }
  double greatest = 0;
  for (layer[vertical_] = 0; layer[vertical_] < along_[vertical_].size(); ++layer[vertical_]) {
    const Particle particle = settled(stress(layer));
    greatest = std::max(greatest, sand_->bulk_modulus(particle.state, -trace(particle.stress) / 3));
  }
  return greatest;
}

template class SettledSand<2>;
template class SettledSand<3>;

}  // namespace tamp::tasks
