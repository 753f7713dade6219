#include "tools/scene/bodies/read_pressure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "components/errors.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tools/scene/json/place_text.hpp"

namespace tamp::tools
{

namespace
{

/// Reads the key by which a pressure is given, one of several.
std::optional<components::PressureCurve> read_curve(JsonReader& reader)
{
  const std::size_t n_before = reader.document().problems.size();
  if (reader.has("value") == reader.has("values")) {
    reader.add_problem("value", reader.has("value") ? "beside values" : "neither value nor values",
                       "expected one of value and values");
    return std::nullopt;
  }
  std::vector<components::PressureCurve::Point> points;
  if (reader.has("value")) {
    points.push_back({0, reader.number("value")});
  } else {
    for (const std::vector<double>& row : reader.rows("values")) points.push_back({row[0], row[1]});
  }
  if (reader.document().problems.size() > n_before) return std::nullopt;
  try {
    return components::PressureCurve(std::move(points));
  } catch (const components::BadValue& bad) {
    const std::string row = bad.row < 0 ? "" : fmt::format("entry {}: ", bad.row);
    reader.add_problem("values", row + bad.found, "expected " + bad.expected);
    return std::nullopt;
  }
}

/// The object "within"; without it a box that holds all.
template <int D>
std::optional<components::PressedBox<3>> read_box(JsonReader& pressure)
{
  auto reader = pressure.optional_object("within");
  if (!reader) return components::PressedBox<3>{};
  const std::size_t n_before = reader->document().problems.size();
  const std::vector<double> lower = reader->numbers("lower");
  const std::vector<double> upper = reader->numbers("upper");
  reader->finish();
  if (reader->document().problems.size() > n_before) return std::nullopt;
  components::PressedBox<3> box;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    box.lower[k] = lower[axis];
    box.upper[k] = upper[axis];
    if (lower[axis] < upper[axis]) continue;
    reader->add_problem("upper", fmt::format("{} along {}", upper[axis], "xyz"[axis]),
                        fmt::format("expected more than lower, {}", lower[axis]));
  }
  if (reader->document().problems.size() > n_before) return std::nullopt;
  return box;
}

/// Does the box hold some of the surface of a body? There the next site of the lattice is not the body's, and not
/// behind a wall.
template <int D>
bool holds_surface(const components::PressedBox<D>& box, const tasks::Scene& scene, const tasks::SceneBody& body)
{
  const auto& solid = std::get<components::Solid<D>>(body.solid);
  const double size = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  const double slack = 1e-9 * size;
  const auto is_pressed = [&](const Vector<D>& site, int axis, int side) {
    Vector<D> next = site;
    next[axis] += (side == 0 ? -1 : 1) * size;
    if (solid.contains(next)) return false;
    const auto k = static_cast<std::size_t>(axis);
    const double face = 0.5 * (site[axis] + next[axis]);
    const double edge = scene.grid.coordinate(axis, side == 0 ? 0 : scene.grid.n_cells[k]);
    const bool is_at_edge = std::abs(face - edge) < slack;
    const tasks::Face& beyond = scene.faces[k][static_cast<std::size_t>(side)];
    if (is_at_edge && components::traits_of(beyond).beyond != components::Beyond::away) return false;
    if (face < box.lower[axis] - slack || face > box.upper[axis] + slack) return false;
    return box.part_of(site, size, size)(axis, side) > 0;
  };
  for (const Vector<D>& site : tasks::sites_of<D>(scene, body)) {
    for (int axis = 0; axis < D; ++axis) {
      if (is_pressed(site, axis, 0) || is_pressed(site, axis, 1)) return true;
    }
  }
  return false;
}

}  // namespace

template <int D>
std::optional<tasks::BodyPressure> read_pressure(JsonReader& body)
{
  auto reader = body.optional_object("pressure");
  if (!reader) return std::nullopt;
  auto curve = read_curve(*reader);
  const auto box = read_box<D>(*reader);
  reader->finish();
  if (!curve || !box) return std::nullopt;
  return tasks::BodyPressure{std::move(*curve), *box};
}

template <int D>
void check_pressed(const tasks::Scene& scene, const tasks::SceneBody& body, JsonReader& reader)
{
  if (body.rigid) {
    reader.add_problem("pressure", "a rigid body, which bears no stress", "expected one that is not rigid");
  }
  const components::PressedBox<D> box = body.pressure->box_of<D>();
  if (holds_surface(box, scene, body)) return;
  if (box.lower.allFinite()) {
    reader.object("pressure")
        .add_problem("within", fmt::format("from {} to {}", text<D>(box.lower), text<D>(box.upper)),
                     "expected a box that holds some of the body's surface");
  } else {
    reader.add_problem("pressure", "a body without a surface, between walls", "expected one with a free side");
  }
}

template std::optional<tasks::BodyPressure> read_pressure<2>(JsonReader&);
template std::optional<tasks::BodyPressure> read_pressure<3>(JsonReader&);
template void check_pressed<2>(const tasks::Scene&, const tasks::SceneBody&, JsonReader&);
template void check_pressed<3>(const tasks::Scene&, const tasks::SceneBody&, JsonReader&);

}  // namespace tamp::tools
