#include "tools/scene/bodies/read_body.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/portable_math.hpp"
#include "tasks/method.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tools/scene/bodies/cut_solid.hpp"
#include "tools/scene/bodies/read_pressure.hpp"
#include "tools/scene/bodies/read_problem.hpp"
#include "tools/scene/bodies/read_solid.hpp"
#include "tools/scene/json/place_text.hpp"
#include "tools/system/capacity.hpp"

namespace tamp::tools
{

namespace
{

template <int D>
Vector<D> point(JsonReader& reader, const std::string& key)
{
  const std::vector<double> numbers = reader.numbers(key);
  return Eigen::Map<const Vector<D>>(numbers.data());
}

/// The keys nose and tail, which go together.
template <int D>
std::optional<tasks::BodyAxis> read_axis(JsonReader& reader)
{
  if (!reader.has("nose") && !reader.has("tail")) return std::nullopt;
  const std::size_t n_before = reader.document().problems.size();
  const Vector<D> nose = point<D>(reader, "nose"), tail = point<D>(reader, "tail");
  if (nose == tail) reader.add_problem("tail", text<D>(tail), "expected another place than the nose's");
  if (reader.document().problems.size() > n_before) return std::nullopt;
  tasks::BodyAxis axis{};
  std::copy(nose.begin(), nose.end(), axis.nose.begin());
  std::copy(tail.begin(), tail.end(), axis.tail.begin());
  return axis;
}

/// Are nose and tail places of the solid? One on its surface may count as outside: what lies a particle's spacing
/// towards the other counts too.
template <int D>
void check_axis(const tasks::BodyAxis& axis, const components::Solid<D>& solid, double spacing,
                const JsonReader& reader)
{
  const Vector<D> nose = tasks::vector_of<D>(axis.nose), tail = tasks::vector_of<D>(axis.tail);
  const auto check = [&](const std::string& key, const Vector<D>& end, const Vector<D>& other) {
    const double length = (other - end).norm();
    const Vector<D> inside = end + std::min(spacing / length, 0.5) * (other - end);
    if (solid.contains(end) || solid.contains(inside)) return;
    reader.add_problem(key, text<D>(end), "expected a place within the body or on its surface");
  };
  check("nose", nose, tail);
  check("tail", tail, nose);
}

/// Whether a body that is to start settled is at rest, and has a stress.
void check_rests(const tasks::SceneBody& body, const JsonReader& reader)
{
  constexpr tasks::Triple zero{0, 0, 0};
  if (body.velocity != zero || body.angular_velocity != zero) {
    reader.add_problem("initial_stress", "a body with a velocity", "expected one at rest");
  }
  if (body.rigid) {
    reader.add_problem("initial_stress", "a rigid body, which has no stress", "expected one that is not rigid");
  }
}

/// The part of a solid that mirrors which cut it in halves leave.
double part_within(const tasks::Sides& mirrors)
{
  double part = 1;
  for (const auto& sides : mirrors) {
    for (const bool cuts : sides) part *= cuts ? 0.5 : 1;
  }
  return part;
}

/// Whether there is memory for the particles of this part of a solid, before they are laid out and counted.
template <int D>
bool has_room_for(const components::Solid<D>& solid, double part, const tasks::Scene& scene, int material,
                  Document& document)
{
  // A particle takes two to four times as much in the run, of which the forecast tells; this is what surely is too
  // much.
  constexpr double least_bytes_of_particle = 400;
  const FreeMemory room = free_memory();
  const components::Box<D> box = solid.bounding_box();
  const double bytes_of_volume =
      part * least_bytes_of_particle / tasks::lattice_of<D>(scene, material).particle_volume();
  // Usually the box around it will do; the volume of a set of solids takes time to find.
  if (bytes_of_volume * (box.upper - box.lower).prod() <= room.bytes) return true;
  const double needed = bytes_of_volume * solid.volume().value, n = needed / least_bytes_of_particle;
  if (needed <= room.bytes) return true;
  constexpr double all_that_it_takes = 2;
  const double fitting = scene.grid.cell_size * std::pow(needed / room.bytes, 1.0 / D);
  document.add_problem(JsonPointer("/grid/cell_size"),
                       fmt::format("{} m: {:.2g} particles in a body, more than {} of memory", scene.grid.cell_size, n,
                                   in_bytes(needed)),
                       fmt::format("expected at most the {} that {}, as with cells of {:.2g} m", in_bytes(room.bytes),
                                   room.why, all_that_it_takes * fitting));
  return false;
}

/// A table of times and vectors.
template <int D>
std::vector<components::PrescribedMotion::Point> read_points(JsonReader& reader, const std::string& key)
{
  std::vector<components::PrescribedMotion::Point> points;
  for (const std::vector<double>& row : reader.rows(key)) {
    points.push_back({row[0], tasks::in_space<D>(Eigen::Map<const Vector<D>>(row.data() + 1))});
  }
  return points;
}

/// Reads the key by which the motion of a driven body is given, one of several.
template <int D>
std::optional<components::PrescribedMotion> read_motion(JsonReader& reader)
{
  const std::size_t n_before = reader.document().problems.size();
  const std::vector<std::string> keys{"velocity", "velocities", "displacements"};
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const std::string& k) { return reader.has(k); });
  const auto n_given = std::count_if(keys.begin(), keys.end(), [&](const std::string& k) { return reader.has(k); });
  if (n_given != 1) {
    reader.add_problem(n_given == 0 ? keys.front() : *key, fmt::format("{} of the keys for it", n_given),
                       "expected one of velocity, velocities and displacements");
    return std::nullopt;
  }
  std::vector<components::PrescribedMotion::Point> points;
  if (*key == "velocity") {
    points.push_back({0, tasks::in_space<D>(point<D>(reader, *key))});
  } else {
    points = read_points<D>(reader, *key);
  }
  if (reader.document().problems.size() > n_before) return std::nullopt;
  try {
    return *key == "displacements" ? components::PrescribedMotion::of_displacements(points)
                                   : components::PrescribedMotion::of_velocities(points);
  } catch (const components::BadValue& bad) {
    reader.add_problem(*key, bad.found, "expected " + bad.expected);
    return std::nullopt;
  }
}

/// The object "driven" of a rigid body.
template <int D>
std::optional<tasks::BodyDrive> read_drive(JsonReader& body, bool rigid)
{
  auto reader = body.optional_object("driven");
  if (!reader) return std::nullopt;
  auto motion = read_motion<D>(*reader);
  const bool turns = reader->choice<bool>("rotation");
  reader->finish();
  if (!rigid) body.add_problem("driven", "a body that is not rigid", "expected a rigid one");
  for (const std::string key : {"velocity", "angular_velocity"}) {
    const bool is_allowed = turns && key == "angular_velocity";
    if (body.has(key) && !is_allowed) {
      body.add_problem(key, "a driven body's", "expected the motion under the key driven alone");
    }
  }
  if (!motion) return std::nullopt;
  return tasks::BodyDrive{std::move(*motion), turns};
}

/// Refuses a rigid body or an axis between periodic boundaries, where its one place would be many.
void check_may_go_around(const tasks::Scene& scene, bool rigid, bool has_axis, const JsonReader& reader)
{
  if (!scene.is_periodic()) return;
  if (rigid) {
    reader.add_problem("rigid", "a rigid body, which cannot go around, between periodic boundaries",
                       "expected one that is not rigid, or other boundaries");
  }
  if (has_axis) {
    reader.add_problem("nose", "a nose, whose surroundings cannot go around, between periodic boundaries",
                       "expected none, or other boundaries");
  }
}

components::Box<2> plane_of(const runtime::Grid& grid)
{
  return {{grid.coordinate(0, 0), grid.coordinate(1, 0)},
          {grid.coordinate(0, grid.n_cells[0]), grid.coordinate(1, grid.n_cells[1])}};
}

/// The rings about the centre of a disk on which its particles are to lie.
template <int D>
std::optional<components::PolarLayout> read_rings(const components::Solid<D>& solid, bool has_problem,
                                                  const JsonReader& reader)
{
  if (has_problem) {
    reader.add_problem("particles", "rings, of a body with a problem", "expected those of the problem alone");
    return std::nullopt;
  }
  if constexpr (D == 2) {
    if (const auto* disk = solid.template get_if<components::Ball<2>>()) {
      return components::PolarLayout{disk->centre, 0, disk->radius};
    }
  }
  reader.add_problem("particles", "rings, of a body that is no disk", "expected a \"ball\" in two dimensions");
  return std::nullopt;
}

/// The usual k0 of a sand at rest (J. Jaky, 1944); none where an elastic layer's stands for it.
std::optional<double> k0_at_rest(const tasks::SceneMaterial& material)
{
  const auto* sand = std::get_if<components::BoltonSand>(&material.model);
  if (sand == nullptr) return std::nullopt;
  return 1 - portable::sin(std::numbers::pi / 180 * sand->critical_friction_angle);
}

template <int D>
std::optional<tasks::SceneBody> read(const std::string& name, JsonReader& reader, const tasks::Scene& scene,
                                     const std::vector<std::string>& material_names, bool grid_is_good)
{
  const std::string material = reader.name("material", material_names);
  const bool rigid = reader.flag("rigid");
  auto drive = read_drive<D>(reader, rigid);
  const bool may_move = !reader.has("driven"), may_turn = may_move || (drive && drive->turns);
  const std::vector<double> velocity = may_move ? reader.numbers("velocity") : std::vector<double>(D, 0.0);
  const std::vector<double> spin = may_turn ? reader.numbers("angular_velocity") : std::vector<double>{0};
  const auto axis = read_axis<D>(reader);
  const auto solid = read_solid<D>(reader, "geometry");
  const auto layout = reader.choice<tasks::ParticleLayout>("particles");
  const bool initial_stress = reader.flag("initial_stress");
  const std::optional<double> k0 = reader.optional_number("k0");
  if (k0 && !initial_stress) {
    reader.add_problem("k0", "that of a body without \"initial_stress\"", "expected it with that key");
  }
  auto pressure = read_pressure<D>(reader);
  const std::size_t n_before = reader.document().problems.size();
  const auto problem = read_problem(reader);
  const bool problem_is_good = reader.document().problems.size() == n_before;
  reader.finish();
  check_may_go_around(scene, rigid, axis.has_value(), reader);
  const bool materials_are_good = scene.materials.size() == material_names.size();
  if (!solid || material.empty() || !grid_is_good || !materials_are_good || !problem_is_good) return std::nullopt;

  const auto at = std::find(material_names.begin(), material_names.end(), material) - material_names.begin();
  const int number = static_cast<int>(at);
  const auto mirrors = mirrors_crossed<D>(*solid, scene, reader);
  if (!mirrors || !has_room_for(*solid, part_within(*mirrors), scene, number, reader.document())) return std::nullopt;
  const auto part = cut_at_mirrors<D>(*solid, *mirrors, scene, number, reader);
  if (!part) return std::nullopt;
  tasks::SceneBody body{name, number, *part, {0, 0, 0}, 0};
  body.cut = *mirrors;
  if (body.is_cut() && problem) {
    reader.add_problem("problem", "a body that a \"symmetry\" face cuts", "expected one that lies within the grid");
    return std::nullopt;
  }
  if (problem) {
    auto functions = functions_of(*problem, reader, scene, scene.materials[static_cast<std::size_t>(number)]);
    if (!functions) return std::nullopt;
    body.functions = std::move(*functions);
  }
  body.particles = layout;
  if (layout == tasks::ParticleLayout::cut && (problem || initial_stress)) {
    reader.add_problem("particles",
                       problem ? "cut, of a body with a problem" : "cut, of a body with \"initial_stress\"",
                       problem ? "expected those of the problem alone" : "expected whole layers: the lattice's");
    return std::nullopt;
  }
  if (layout == tasks::ParticleLayout::rings) {
    body.functions.layout = read_rings<D>(*solid, problem.has_value(), reader);
    if (body.functions.layout && body.is_cut()) body.functions.layout->part = plane_of(scene.grid);
  }
  body.n_particles = tasks::sites_of<D>(scene, body).size();
  if (body.n_particles == 0) {
    reader.add_problem("geometry", "holds no particle",
                       fmt::format("expected a shape that holds a site of the particle lattice, whose spacing is {} m",
                                   scene.grid.cell_size / scene.particles_per_axis_of(number)));
    return std::nullopt;
  }
  if (rigid && body.n_particles == 1) {
    reader.add_problem("rigid", "a rigid body of one particle", "expected two or more, so that it has an orientation");
  }
  std::copy(velocity.begin(), velocity.end(), body.velocity.begin());
  std::copy(spin.begin(), spin.end(), body.angular_velocity.end() - static_cast<std::ptrdiff_t>(spin.size()));
  body.rigid = rigid;
  if (drive) {
    const Vector<3> at_start = drive->motion.velocity(0);
    std::copy(at_start.begin(), at_start.end(), body.velocity.begin());
    body.drive = std::move(drive);
  }
  body.axis = axis;
  body.initial_stress = initial_stress;
  body.k0 = initial_stress && !k0 ? k0_at_rest(scene.materials[static_cast<std::size_t>(number)]) : k0;
  body.pressure = std::move(pressure);
  if (axis) check_axis<D>(*axis, *solid, scene.grid.cell_size / scene.particles_per_axis_of(number), reader);
  if (initial_stress) check_rests(body, reader);
  if (body.pressure) check_pressed<D>(scene, body, reader);
  if (problem) check_functions<D>(scene, body, reader);
  return body;
}

}  // namespace

std::optional<tasks::SceneBody> read_body(const std::string& name, JsonReader reader, const tasks::Scene& scene,
                                          const std::vector<std::string>& material_names, bool grid_is_good)
{
  return scene.grid.dimension == 2 ? read<2>(name, reader, scene, material_names, grid_is_good)
                                   : read<3>(name, reader, scene, material_names, grid_is_good);
}

}  // namespace tamp::tools
