#include "tasks/set_up/settled_ground.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include "components/alternatives.hpp"
#include "components/errors.hpp"
#include "tasks/set_up/body_sites.hpp"

namespace tamp::tasks
{

using components::BadValue;
using components::LayerColumn;

std::vector<std::string_view> settling_types()
{
  std::vector<std::string_view> types;
  components::for_each_alternative<MaterialModel>([&]<class Model>(std::type_identity<Model>) {
    if constexpr (components::Settling<Model>) types.push_back(Model::type);
  });
  return types;
}

bool are_strata(const Scene& scene, int material_a, int material_b)
{
  const auto starts_settled = [&](int material) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const SceneBody& body) { return body.initial_stress && body.material == material; });
  };
  return starts_settled(material_a) && starts_settled(material_b);
}

namespace
{

/// Ratio of the stress across to that along the vertical in an elastic layer that cannot widen.
double elastic_k0(const SceneMaterial& material)
{
  return std::visit(
      [&]<class Model>(const Model& model) -> double {
        if constexpr (components::Settling<Model>) {
          const double nu = model.poisson_ratio();
          return nu / (1 - nu);
        } else {
          throw BadValue(fmt::format("material \"{}\" of type {}", material.name, Model::type),
                         fmt::format("one of type {}", fmt::join(settling_types(), ", ")));
        }
      },
      material.model);
}

/// The layers of particles along an axis, and the walls that they stand between.
LayerColumn column_of(const Scene& scene, const SceneBody& body, std::vector<double> layers, std::size_t k)
{
  const runtime::Grid& grid = scene.grid;
  const int axis = static_cast<int>(k), n_cells = grid.n_cells[k];
  LayerColumn column;
  column.spacing = grid.cell_size / scene.particles_per_axis_of(body.material);
  column.nodes = {Vector<1>(grid.coordinate(axis, -1)), grid.cell_size, {n_cells + 3}, {1}};
  const double reach = 0.75 * column.spacing;
  const bool at_lower = layers.front() - grid.coordinate(axis, 0) < reach;
  const bool at_upper = grid.coordinate(axis, n_cells) - layers.back() < reach;
  // Ground that fills a periodic axis goes on beyond both ends, as between mirrors.
  column.lower_wall =
      grid.periodic[k] ? at_lower && at_upper : at_lower && components::traits_of(scene.faces[k][0]).is_wall();
  column.upper_wall =
      grid.periodic[k] ? at_lower && at_upper : at_upper && components::traits_of(scene.faces[k][1]).is_wall();
  column.density.assign(layers.size(), scene.materials[static_cast<std::size_t>(body.material)].density);
  column.layers = std::move(layers);
  return column;
}

/// The shape that a body must have for its stress to be known without a run.
constexpr const char* a_box = "a box along the axes; other ground can settle in the run, with \"local_damping\"";

/// The columns of layers along each axis of a body's particles, which must fill a box.
template <int D>
std::array<LayerColumn, std::size_t{D}> columns_of(const Scene& scene, const SceneBody& body)
{
  const std::vector<Vector<D>> sites = sites_of<D>(scene, body);
  if (sites.empty()) throw BadValue("a region without particles", a_box);
  std::array<LayerColumn, std::size_t{D}> columns;
  std::size_t n_in_box = 1;
  for (std::size_t k = 0; k < D; ++k) {
    std::vector<double> layers;
    layers.reserve(sites.size());
    for (const Vector<D>& x : sites) layers.push_back(x[static_cast<Eigen::Index>(k)]);
    std::sort(layers.begin(), layers.end());
    layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
    columns[k] = column_of(scene, body, std::move(layers), k);
    const double extent = columns[k].layers.back() - columns[k].layers.front();
    const auto n_between = static_cast<std::size_t>(std::lround(extent / columns[k].spacing));
    if (columns[k].layers.size() != n_between + 1) {
      throw BadValue(fmt::format("a region with a gap along {}", "xyz"[k]), a_box);
    }
    n_in_box *= columns[k].layers.size();
  }
  if (sites.size() == n_in_box) return columns;
  throw BadValue(fmt::format("a region with {} of the {} particles of the box around it", sites.size(), n_in_box),
                 a_box);
}

constexpr const char* between_walls = "sides and floor on walls, and one free face";

/// The axis along which the body is not between two walls.
template <int D>
std::size_t vertical_axis(const std::array<LayerColumn, std::size_t{D}>& columns)
{
  std::string open;
  std::size_t vertical = 0;
  for (std::size_t k = 0; k < D; ++k) {
    if (columns[k].lower_wall && columns[k].upper_wall) continue;
    open += "xyz"[k];
    vertical = k;
  }
  if (open.empty()) throw BadValue("a body between walls along every axis", between_walls);
  if (open.size() > 1) throw BadValue("a body not between walls along " + open, between_walls);
  return vertical;
}

/// A body that starts settled, and its layers along the vertical.
struct Stratum {
  const SceneBody* body;
  LayerColumn column;
};

/// All bodies that start settled, from the lower end of the vertical axis on.
template <int D>
std::vector<Stratum> strata_of(const Scene& scene, std::size_t vertical)
{
  std::vector<Stratum> strata;
  for (const SceneBody& body : scene.bodies) {
    if (!body.initial_stress) continue;
    try {
      strata.push_back({&body, columns_of<D>(scene, body)[vertical]});
    } catch (const BadValue& bad) {
      throw BadValue(fmt::format("in body \"{}\" {}", body.name, bad.found), bad.expected);
    }
  }
  std::sort(strata.begin(), strata.end(),
            [](const Stratum& a, const Stratum& b) { return a.column.layers.front() < b.column.layers.front(); });
  return strata;
}

void check_touch(const Scene& scene, const Stratum& below, const Stratum& above)
{
  const int n = scene.particles_per_axis_of(below.body->material);
  if (const int other = scene.particles_per_axis_of(above.body->material); other != n) {
    throw BadValue(fmt::format("{} particles along the edge of a cell in body \"{}\", {} in body \"{}\"", n,
                               below.body->name, other, above.body->name),
                   "the same number in all bodies that start settled");
  }
  const double gap = above.column.layers.front() - below.column.layers.back() - below.column.spacing;
  if (std::abs(gap) < 0.5 * below.column.spacing) return;
  throw BadValue(
      fmt::format("a gap of {:.4g} m between bodies \"{}\" and \"{}\"", gap, below.body->name, above.body->name),
      "bodies that lie on one another");
}

/// Checks that no three materials meet at a node, where their contacts one after another would not hold them at rest.
void check_is_thick(const Scene& scene, const Stratum& below, const Stratum& between, const Stratum& above)
{
  if (below.body->material == between.body->material || between.body->material == above.body->material) return;
  constexpr double round_off = 1e-9;
  const double h = scene.grid.cell_size, origin = below.column.nodes.origin[0];
  const double reach = scene.reach_of(between.body->material) - round_off;
  const double lower = (above.column.layers.front() - origin) / h - reach;
  const double upper = (below.column.layers.back() - origin) / h + reach;
  if (std::ceil(lower) > std::floor(upper)) return;
  throw BadValue(fmt::format("body \"{}\", so thin that \"{}\" and \"{}\" meet at a node within it", between.body->name,
                             below.body->name, above.body->name),
                 "a thicker one, or finer cells");
}

/// The layers of all strata together.
LayerColumn pile_of(const Scene& scene, const std::vector<Stratum>& strata)
{
  LayerColumn pile = strata.front().column;
  for (std::size_t i = 1; i < strata.size(); ++i) {
    check_touch(scene, strata[i - 1], strata[i]);
    if (i + 1 < strata.size()) check_is_thick(scene, strata[i - 1], strata[i], strata[i + 1]);
    const LayerColumn& next = strata[i].column;
    pile.layers.insert(pile.layers.end(), next.layers.begin(), next.layers.end());
    pile.density.insert(pile.density.end(), next.density.begin(), next.density.end());
    pile.upper_wall = next.upper_wall;
  }
  return pile;
}

/// The body force along each axis: gravity, and the centrifugal force on matter at rest in the turning frame.
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

/// Tangent bulk modulus of a model whose particle bears this stress [Pa].
template <class Model>
double settled_bulk_modulus(const Model& model, const components::SettledStress& settled)
{
  const double pressure = -trace(settled.stress) / 3;
  constexpr bool changes = requires
  {
    model.bulk_modulus(model.settled_state(settled), pressure);
  };
  if constexpr (changes) {
    return model.bulk_modulus(model.settled_state(settled), pressure);
  } else {
    return model.initial_moduli().bulk_modulus;
  }
}

}  // namespace

template <int D>
SettledGround<D>::SettledGround(const Scene& scene, const SceneBody& body)
    : model_(&scene.materials[static_cast<std::size_t>(body.material)].model)
{
  const double usual_k0 = elastic_k0(scene.materials[static_cast<std::size_t>(body.material)]);
  k0_ = body.k0.value_or(usual_k0);
  columns_ = columns_of<D>(scene, body);
  vertical_ = vertical_axis<D>(columns_);
  const LayerColumn pile = pile_of(scene, strata_of<D>(scene, vertical_));
  if (pile.lower_wall == pile.upper_wall) {
    throw BadValue(fmt::format("{} walls along {}", pile.lower_wall ? "two" : "no", "xyz"[vertical_]), between_walls);
  }
  const auto force = body_force<D>(scene);
  const int particles_per_axis = scene.particles_per_axis_of(body.material);
  for (std::size_t k = 0; k < D; ++k) {
    const LayerColumn& column = k == vertical_ ? pile : columns_[k];
    along_[k] = components::settled_stress(scene.interpolator, particles_per_axis, column, force[k]);
  }
  // The body's own layers are a part of those of the pile.
  const std::vector<double>&own = columns_[vertical_].layers, of_pile = along_[vertical_];
  const auto first = std::lower_bound(pile.layers.begin(), pile.layers.end(), own.front()) - pile.layers.begin();
  const auto begin = of_pile.begin() + first;
  along_[vertical_] = std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(own.size()));
}

template <int D>
components::SettledStress SettledGround<D>::stress(const Layer& layer) const
{
  const double vertical = along_[vertical_][layer[vertical_]];
  SymmetricTensor<3> stress = isotropic<n_symmetric<3>>(k0_ * vertical);
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    stress[axis] = k == vertical_ ? vertical : stress[axis] + along_[k][layer[k]];
  }
  return {stress, -std::max(1.0, k0_) * vertical};
}

template <int D>
components::SettledStress SettledGround<D>::at(const Vector<D>& x) const
{
  Layer layer;
  for (std::size_t k = 0; k < D; ++k) {
    const LayerColumn& column = columns_[k];
    layer[k] = static_cast<std::size_t>(
        std::lround((x[static_cast<Eigen::Index>(k)] - column.layers.front()) / column.spacing));
  }
  return stress(layer);
}

template <int D>
void SettledGround<D>::check_at(const Vector<D>& x) const
{
  try {
    std::visit(
        [&]<class Model>(const Model& model) {
          if constexpr (components::Settling<Model>) model.settled_state(at(x));
        },
        *model_);
  } catch (const BadValue& bad) {
    throw BadValue(fmt::format("{} at [{}]", bad.found, fmt::join(x.data(), x.data() + D, ", ")), bad.expected);
  }
}

template <int D>
double SettledGround<D>::greatest_bulk_modulus() const
{
  Layer layer;
  for (std::size_t k = 0; k < D; ++k) {
    layer[k] = static_cast<std::size_t>(std::min_element(along_[k].begin(), along_[k].end()) - along_[k].begin());
  }
  double greatest = 0;
  for (layer[vertical_] = 0; layer[vertical_] < along_[vertical_].size(); ++layer[vertical_]) {
    const components::SettledStress settled = stress(layer);
    greatest = std::max(greatest,
                        std::visit([&](const auto& model) { return settled_bulk_modulus(model, settled); }, *model_));
  }
  return greatest;
}

template class SettledGround<2>;
template class SettledGround<3>;

}  // namespace tamp::tasks
