#include "tools/advice/wave_box.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

#include "tools/advice/penetration.hpp"
#include "tools/scene/bodies/symmetry.hpp"
#include "tools/scene/files/digits.hpp"

namespace tamp::tools
{

namespace
{

/// The way from a body to a side of the ground, along an axis.
struct Side {
  int axis;
  bool is_upper;
  /// Distance from the body to the ground's end [m]; 0 or less where the body reaches beyond it.
  double room;
  /// Least distance of the ground's end at which no wave comes back from it to the body in time [m].
  double needed;
  /// Times at which a wave is at the ground's end, and back at the body [s]; for a body as fast as waves, the time at
  /// which it is there itself.
  double there, back;
  bool is_outrun;

  std::string name() const { return fmt::format("{}{}", "xyz"[axis], is_upper ? '+' : '-'); }
  Eigen::Vector3d direction() const { return (is_upper ? 1 : -1) * Eigen::Vector3d::Unit(axis); }
};

/// Place along a direction where waves start [m]: at the nose, if the body has one, or else all along it.
double start_of_waves(const tasks::SceneBody& body, const Eigen::Vector3d& direction)
{
  return body.axis ? Eigen::Vector3d(body.axis->nose.data()).dot(direction) : reach(body, direction);
}

Side side_of(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& ground, int axis,
             bool is_upper)
{
  Side side{.axis = axis, .is_upper = is_upper, .room = 0, .needed = 0, .there = 0, .back = 0, .is_outrun = false};
  const Eigen::Vector3d direction = side.direction();
  const double T = scene.time.end, c = waves_in(scene, ground);
  const double speed = std::max(0.0, way_of(scene, body).dot(direction) / T);
  side.room = reach(ground, direction) - start_of_waves(body, direction);
  side.needed = std::max(speed, 0.5 * (c + speed)) * T;
  side.is_outrun = speed >= c;
  side.there = side.room / std::max(c, speed);
  side.back = side.is_outrun ? side.there : 2 * side.room / (c + speed);
  return side;
}

std::vector<Side> sides_of(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& ground)
{
  std::vector<Side> sides;
  sides.reserve(6);
  for (int axis = 0; axis < scene.grid.dimension; ++axis) {
    if (scene.grid.periodic[static_cast<std::size_t>(axis)] || is_one_cell_thick(scene, axis)) continue;
    for (const bool is_upper : {false, true}) {
      const Side side = side_of(scene, body, ground, axis, is_upper);
      if (reach(body, side.direction()) < reach(ground, side.direction()) && side.room > 0) sides.push_back(side);
    }
  }
  return sides;
}

/// Number of whole cells at a side that can be left out: no wave comes back from there in time, and no body but the
/// ground comes near.
int spare_cells(const tasks::Scene& scene, const tasks::SceneBody& ground, const Side& side)
{
  // Contact and weights spread an impact over a few cells at once.
  constexpr double spread = 4, near = 3;
  const double h = scene.grid.cell_size;
  double spare = side.room - side.needed - spread * h;
  for (const tasks::SceneBody& other : scene.bodies) {
    if (&other == &ground) continue;
    const double comes_to = reach(other, side.direction()) + std::max(0.0, way_of(scene, other).dot(side.direction()));
    spare = std::min(spare, reach(ground, side.direction()) - comes_to - near * h);
  }
  return std::max(0, static_cast<int>(std::floor(spare / h)));
}

std::string list_of(std::span<const double> values)
{
  return fmt::format("[{:.6g}]", fmt::join(values, ","));
}

/// A grid without the cells that are spare at its sides.
struct SmallerGrid {
  std::vector<double> lower, upper;
  std::vector<int> n_patches;
  double part = 1;  ///< share of the cells that is left

  SmallerGrid(const tasks::Scene& scene, const tasks::SceneBody& ground, const std::vector<Side>& sides)
  {
    std::array<std::array<int, 2>, 3> spare{};
    for (const Side& side : sides) {
      spare[static_cast<std::size_t>(side.axis)][side.is_upper ? 1 : 0] = spare_cells(scene, ground, side);
    }
    for (int axis = 0; axis < scene.grid.dimension; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const int n = scene.grid.n_cells[k] - spare[k][0] - spare[k][1], patches = scene.n_patches[k];
      lower.push_back(scene.grid.coordinate(axis, spare[k][0]));
      upper.push_back(scene.grid.coordinate(axis, scene.grid.n_cells[k] - spare[k][1]));
      const bool divides = n % patches == 0 && n / patches >= tasks::least_patch_width(scene.interpolator);
      n_patches.push_back(divides ? patches : 1);
      part *= static_cast<double>(n) / scene.grid.n_cells[k];
    }
  }

  /// The smaller grid as options --set, with the ground cut to it.
  std::string settings(const tasks::SceneBody& ground) const
  {
    std::string text = fmt::format("/grid/lower={} /grid/upper={} /grid/patches=[{}]", list_of(lower), list_of(upper),
                                   fmt::join(n_patches, ","));
    const auto cut = [&](const auto& solid) { text += cut_to_grid(solid, ground.name); };
    std::visit(cut, ground.solid);
    return text;
  }

 private:
  template <int D>
  std::string cut_to_grid(const components::Solid<D>& solid, const std::string& name) const
  {
    const auto* box = solid.template get_if<components::Box<D>>();
    if (box == nullptr) return fmt::format(" and {} cut to it", name);
    std::vector<double> from(lower), to(upper);
    for (std::size_t k = 0; k < D; ++k) {
      from[k] = std::max(from[k], box->lower[static_cast<int>(k)]);
      to[k] = std::min(to[k], box->upper[static_cast<int>(k)]);
    }
    return fmt::format(" /bodies/{0}/geometry/lower={1} /bodies/{0}/geometry/upper={2}", name, list_of(from),
                       list_of(to));
  }
};

}  // namespace

std::string advice_on_box(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& ground)
{
  const std::vector<Side> sides = sides_of(scene, body, ground);
  if (sides.empty()) return "";
  const auto sooner = [](const Side& a, const Side& b) { return a.back < b.back; };
  const Side& first = *std::min_element(sides.begin(), sides.end(), sooner);
  const double T = scene.time.end, c = waves_in(scene, ground);
  std::string line = fmt::format("box: waves in {} ({:.0f} m/s) ", ground.name, c);
  if (first.is_outrun && first.back < T) {
    line += fmt::format("are outrun by {}, which is at its side {} after {} ms, of {} ms", body.name, first.name(),
                        two_digits(1e3 * first.there), two_digits(1e3 * T));
  } else if (first.back < T) {
    line += fmt::format("reach its side {} after {} ms and are back at {} after {} ms, of {} ms", first.name(),
                        two_digits(1e3 * first.there), body.name, two_digits(1e3 * first.back), two_digits(1e3 * T));
  } else {
    line += fmt::format("travel {:.2g} m in {} ms and do not return to {} from any side", c * T, two_digits(1e3 * T),
                        body.name);
  }
  const SmallerGrid smaller(scene, ground, sides);
  constexpr double worth_it = 0.8;
  if (smaller.part > worth_it) return line;
  return line + fmt::format("; {:.2g} of the cells are enough, with {}", smaller.part, smaller.settings(ground));
}

}  // namespace tamp::tools
