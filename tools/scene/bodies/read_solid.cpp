#include "tools/scene/bodies/read_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <utility>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/closed_mesh.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/ogive.hpp"
#include "components/geometry/polygon.hpp"
#include "components/geometry/revolved.hpp"
#include "components/geometry/rotations.hpp"
#include "components/geometry/section.hpp"
#include "components/geometry/set_operations.hpp"
#include "components/geometry/transformed.hpp"
#include "components/geometry/turned_section.hpp"
#include "tools/scene/files/input_file.hpp"

namespace tamp::tools
{

namespace
{

using components::Solid;

/// Makes a solid from values that have been read; may throw BadValue.
template <int D>
using Make = std::function<Solid<D>()>;

/// A value of "type". `rows` is the key whose rows a BadValue numbers.
template <int D>
struct Kind {
  std::string type;
  Make<D> (*read)(JsonReader& reader);
  std::string rows;
};

template <int D>
std::optional<Solid<D>> read_at(Document& document, const JsonPointer& pointer);

template <int D>
Vector<D> vector(JsonReader& reader, const std::string& key)
{
  const std::vector<double> numbers = reader.numbers(key);
  return Eigen::Map<const Vector<D>>(numbers.data());
}

double radians(double degrees)
{
  return degrees * std::numbers::pi / 180;
}

template <int D>
Make<D> read_box(JsonReader& reader)
{
  const components::Box<D> box{vector<D>(reader, "lower"), vector<D>(reader, "upper")};
  return [=] { return Solid<D>(box); };
}

template <int D>
Make<D> read_ball(JsonReader& reader)
{
  const components::Ball<D> ball{vector<D>(reader, "centre"), reader.number("radius")};
  return [=] { return Solid<D>(ball); };
}

template <int D>
Make<D> read_rotated_box(JsonReader& reader)
{
  const Vector<D> centre = vector<D>(reader, "centre"), sides = vector<D>(reader, "sides");
  const double angle = radians(reader.number("angle"));
  return [=] { return Solid<D>(components::RotatedBox<D>{centre, sides, components::plane_rotation<D>(angle)}); };
}

Make<3> read_cylinder(JsonReader& reader)
{
  const Vector<3> first = vector<3>(reader, "first_end"), second = vector<3>(reader, "second_end");
  const double radius = reader.number("radius");
  return [=] { return Solid<3>(components::Cylinder{first, second, radius}); };
}

Make<3> read_cone(JsonReader& reader)
{
  const Vector<3> first = vector<3>(reader, "first_end"), second = vector<3>(reader, "second_end");
  const double first_radius = reader.number("first_radius");
  const double second_radius = reader.number("second_radius");
  return [=] { return Solid<3>(components::Cone{first, second, first_radius, second_radius}); };
}

Make<3> read_ogive(JsonReader& reader)
{
  const components::Ogive ogive{vector<3>(reader, "tip"), vector<3>(reader, "base"), reader.number("radius")};
  return [=] { return Solid<3>(ogive); };
}

Make<3> read_revolved(JsonReader& reader)
{
  const Vector<3> start = vector<3>(reader, "start"), axis = vector<3>(reader, "axis");
  std::vector<components::ProfilePoint> profile;
  for (const std::vector<double>& row : reader.rows("profile")) profile.push_back({row[0], row[1]});
  const std::optional<double> tip_radius = reader.optional_number("tip_radius");
  return [=] { return Solid<3>(components::Revolved(start, axis, profile, tip_radius)); };
}

std::vector<Vector<2>> corners(JsonReader& reader)
{
  std::vector<Vector<2>> corners;
  for (const std::vector<double>& row : reader.rows("corners")) corners.emplace_back(row[0], row[1]);
  return corners;
}

Make<2> read_polygon(JsonReader& reader)
{
  return [corners = corners(reader)] { return Solid<2>(components::Polygon(corners)); };
}

Make<3> read_extruded_polygon(JsonReader& reader)
{
  const double lower = reader.number("lower"), upper = reader.number("upper");
  return [corners = corners(reader), lower, upper] {
    return Solid<3>(components::ExtrudedPolygon{components::Polygon(corners), lower, upper});
  };
}

Make<3> read_mesh(JsonReader& reader)
{
  const std::filesystem::path file = reader.existing_file("stl");
  const double scale = reader.number("scale");
  return [=] {
    std::istringstream stl(read_input_file(file));
    try {
      return Solid<3>(components::ClosedMesh(stl, scale));
    } catch (const components::BadValue& bad) {
      throw components::BadValue(file.string() + " holds " + bad.found, bad.expected);
    }
  };
}

/// The solids of the list at "of"; those with problems are left out.
template <int D>
std::vector<Solid<D>> parts(JsonReader& reader)
{
  std::vector<Solid<D>> parts;
  const std::size_t n = reader.objects("of").size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto part = read_at<D>(reader.document(), reader.pointer("of") / i);
    if (part) parts.push_back(*part);
  }
  return parts;
}

template <int D>
Make<D> read_union(JsonReader& reader)
{
  return [parts = parts<D>(reader)] { return Solid<D>(components::Union<D>{parts}); };
}

template <int D>
Make<D> read_intersection(JsonReader& reader)
{
  return [parts = parts<D>(reader)] { return Solid<D>(components::Intersection<D>{parts}); };
}

template <int D>
Make<D> read_difference(JsonReader& reader)
{
  return [parts = parts<D>(reader)] {
    if (parts.empty()) throw components::BadValue("no solids", "1 or more");
    return Solid<D>(components::Difference<D>{parts.front(), {parts.begin() + 1, parts.end()}});
  };
}

/// Makes rotations about the origin; in space about the axis that stands at "axis".
template <int D>
std::function<Matrix<D>(double)> rotation_about(JsonReader& reader)
{
  if constexpr (D == 3) {
    return [axis = vector<3>(reader, "axis")](double angle) { return components::axis_rotation(axis, angle); };
  } else {
    return components::plane_rotation<2>;
  }
}

template <int D>
Make<D> read_transform(JsonReader& reader)
{
  const auto solid = read_solid<D>(reader, "of");
  const Vector<D> translation = vector<D>(reader, "translation");
  std::function<Matrix<D>()> rotation = [] { return Matrix<D>(Matrix<D>::Identity()); };
  if (auto given = reader.optional_object("rotation")) {
    rotation = [about = rotation_about<D>(*given), angle = radians(given->number("angle"))] { return about(angle); };
    given->finish();
  }
  return [=] { return Solid<D>(components::Transformed<D>{*solid, rotation(), translation}); };
}

template <int D>
Make<D> read_ring(JsonReader& reader)
{
  const auto solid = read_solid<D>(reader, "of");
  const int count = reader.whole_number("count");
  return [=, about = rotation_about<D>(reader)] {
    components::Union<D> ring;
    for (int i = 0; i < count; ++i) {
      const Matrix<D> rotation = about(2 * std::numbers::pi * i / count);
      ring.parts.push_back(Solid<D>(components::Transformed<D>{*solid, rotation, Vector<D>::Zero()}));
    }
    return Solid<D>(ring);
  };
}

/// Warns of a solid that is not round about the axis of its scene: its section turned about the axis then has another
/// volume than the solid, and so another mass.
void expect_round(const Solid<3>& solid, const std::string& pointer, std::vector<std::string>& warnings)
{
  // The many facets of a mesh count as round. Equal volumes alone do not: a cylinder across the line may have them.
  const auto [own, turned, apart] = components::volumes_of_turning(solid);
  const double off = std::abs(turned - own);
  if (off <= 0.005 * own && apart <= 0.05 * own) return;
  // A simple shape knows its volume.
  const std::string found =
      fmt::format("a solid of {:.3g} m3, whose section holds {:.3g} m3 when it is turned about x = z = 0",
                  solid.n_shapes() == 1 ? solid.volume().value : own, turned);
  if (off > 0.05 * own || apart > 0.2 * own) {
    throw components::BadValue(fmt::format("{}, {:.3g} m3 in one of them alone", found, apart),
                               "a solid that is round about that line");
  }
  warnings.push_back(fmt::format("{}: {}: it is not quite round about that line", pointer, found));
}

/// The plane of a solid that is read as those of scenes in space are.
Make<2> read_section(JsonReader& reader)
{
  Document& document = reader.document();
  const int of_scene = std::exchange(document.dimension, 3);
  const auto solid = read_solid<3>(reader, "of");
  document.dimension = of_scene;
  return [solid, &document, pointer = reader.pointer("of").to_string()] {
    if (document.axisymmetric) expect_round(*solid, pointer, document.warnings);
    return Solid<2>(components::Section{*solid});
  };
}

template <int D>
std::vector<Kind<D>> kinds()
{
  std::vector<Kind<D>> all{
      {"box", read_box<D>, ""}, {"ball", read_ball<D>, ""}, {"rotated_box", read_rotated_box<D>, ""}};
  const auto add = [&](std::vector<Kind<D>> more) { all.insert(all.end(), more.begin(), more.end()); };
  if constexpr (D == 2) {
    add({{"polygon", read_polygon, "corners"}, {"section", read_section, ""}});
  } else {
    add({{"cylinder", read_cylinder, ""},
         {"cone", read_cone, ""},
         {"ogive", read_ogive, ""},
         {"revolved", read_revolved, "profile"},
         {"extruded_polygon", read_extruded_polygon, "corners"},
         {"mesh", read_mesh, ""}});
  }
  add({{"union", read_union<D>, ""},
       {"intersection", read_intersection<D>, ""},
       {"difference", read_difference<D>, ""},
       {"transform", read_transform<D>, ""},
       {"ring", read_ring<D>, ""}});
  return all;
}

/// Solids that a scene may name, and shapes that a body may be made of in the end: each particle site asks them.
constexpr std::size_t most_solids = 1000, most_shapes = 10'000;

/// Solids within solids, and a file that names itself on the way down, come to an end.
bool is_too_deep(const JsonPointer& pointer)
{
  const std::string text = pointer.to_string();
  return std::count(text.begin(), text.end(), '/') > 60;
}

template <int D>
std::optional<Solid<D>> read_at(Document& document, const JsonPointer& pointer)
{
  if (is_too_deep(pointer)) {
    document.add_problem(pointer, "too many solids, one within the other", "expected a file that does not name itself");
    return std::nullopt;
  }
  if (document.n_solids == most_solids) return std::nullopt;
  if (++document.n_solids == most_solids) {
    document.add_problem(pointer, fmt::format("the {}th solid of the scene", most_solids), "expected fewer");
    return std::nullopt;
  }
  const std::size_t n_before = document.problems.size();
  document.merge_file_named_at(pointer, solid_keys());
  JsonReader reader(document, solid_keys(), pointer);
  reader.expect_numbers_to_multiply();
  const std::string type = reader.type();
  if (type.empty()) return std::nullopt;

  const std::vector<Kind<D>> all = kinds<D>();
  const Kind<D>& kind = *std::find_if(all.begin(), all.end(), [&](const Kind<D>& k) { return k.type == type; });
  const Make<D> make = kind.read(reader);
  reader.finish();
  if (document.problems.size() > n_before) return std::nullopt;
  try {
    const Solid<D> solid = make();
    if (solid.n_shapes() <= most_shapes) return solid;
    document.add_problem(pointer, fmt::format("made of {} solids", solid.n_shapes()),
                         fmt::format("expected at most {} in a body", most_shapes));
    return std::nullopt;
  } catch (const components::BadValue& bad) {
    const JsonPointer place = bad.row < 0 ? pointer : pointer / kind.rows / static_cast<std::size_t>(bad.row);
    document.add_problem(place, bad.found, "expected " + bad.expected);
    return std::nullopt;
  }
}

}  // namespace

template <int D>
std::optional<components::Solid<D>> read_solid(JsonReader& holder, const std::string& key)
{
  const std::size_t n_before = holder.document().problems.size();
  holder.object(key);
  if (!holder.has(key) || holder.document().problems.size() > n_before) return std::nullopt;
  return read_at<D>(holder.document(), holder.pointer(key));
}

template std::optional<components::Solid<2>> read_solid<2>(JsonReader&, const std::string&);
template std::optional<components::Solid<3>> read_solid<3>(JsonReader&, const std::string&);

}  // namespace tamp::tools
