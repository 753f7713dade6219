#include "tools/scene/json/keys.hpp"

namespace tamp::tools
{

namespace
{

const ObjectKeys& rotation_keys()
{
  static const ObjectKeys keys{
      "", {{"axis", Numbers{just(3)}, "", compulsory, "", 3}, {"angle", Number{}, "degrees", compulsory, ""}}};
  return keys;
}

/// A place or a direction.
Key place_key(std::string name, std::string unit = "m", Range range = any_number)
{
  return {std::move(name), Numbers{per_axis, range}, std::move(unit), compulsory, ""};
}

Key length_key(std::string name, Range range)
{
  return {std::move(name), Number{range}, "m", compulsory, ""};
}

Key rows_key(std::string name, const std::string& row)
{
  return {std::move(name), Rows{just(2)}, "m", compulsory, "`[" + row + ", ...]`"};
}

}  // namespace

const ObjectKeys& solid_keys()
{
  static const Key solids{"of", Objects{solid_keys}, "", {Json::array()}, "a list of solids"};
  static const Key solid{"of", Object{solid_keys}, "", compulsory, "a solid"};
  static const Key corners = rows_key("corners", "[x, y]");
  static const ObjectKeys keys{
      .name = "solid",
      .keys = {{"title", Text{}, "", none, "one line for people"}},
      .types =
          {{"box", {place_key("lower"), place_key("upper")}, "edges along the axes"},
           {"ball",
            {place_key("centre"), length_key("radius", above_zero)},
            "a disk in two dimensions, a sphere in three"},
           {"rotated_box",
            {place_key("centre"), place_key("sides", "m", above_zero), {"angle", Number{}, "degrees", compulsory, ""}},
            "a box turned about its centre from x towards y"},
           {"polygon", {corners}, "within straight edges that do not cross or touch", 2},
           {"section",
            {{"of", Object{solid_keys}, "", compulsory, "a solid of three dimensions"}},
            "the section z = 0 of a solid of three dimensions, whose places have three coordinates. An axisymmetric "
            "scene turns it about x = z = 0, and refuses a solid that is not round about that line: whose volume is "
            "more than 5 % from that of the turned section",
            2},
           {"cylinder",
            {place_key("first_end"), place_key("second_end"), length_key("radius", above_zero)},
            "a right circular cylinder",
            3},
           {"cone",
            {place_key("first_end"), place_key("second_end"), length_key("first_radius", zero_or_above),
             length_key("second_radius", zero_or_above)},
            "a cone, cut off where both radii are above 0",
            3},
           {"ogive",
            {place_key("tip"), place_key("base"), length_key("radius", above_zero)},
            "a tangent ogive from its pointed tip to the centre of its base, which has the radius",
            3},
           {"revolved",
            {place_key("start"),
             place_key("axis", ""),
             rows_key("profile", "[s, r]"),
             {"tip_radius", Number{above_zero}, "m", none, ""}},
            "a body of revolution, of radius r at the distance s from `start` along `axis`. Between the points r² is a "
            "smooth curve that rises and falls only where they do. `tip_radius`, which may be left out, is the radius "
            "of curvature of a tip, where the first r is 0",
            3},
           {"extruded_polygon",
            {corners, length_key("lower", any_number), length_key("upper", any_number)},
            "a polygon of the x-y plane from z = `lower` to z = `upper`",
            3},
           {"mesh",
            {{"stl", File{}, "", compulsory, "a file"}, {"scale", Number{above_zero}, "", {1.0}, ""}},
            "within the triangles of an STL file, binary or text, whose coordinates times `scale` are metres; the "
            "surface must be closed and not cross itself, and one in another face the other way, into the void",
            3},
           {"union", {solids}, "the union of these solids"},
           {"intersection", {solids}, "what all of them hold"},
           {"difference", {solids}, "the first solid without the others"},
           {"transform",
            {solid,
             {"rotation", Object{rotation_keys}, "", none, ""},
             {"translation", Numbers{per_axis}, "m", {0.0}, ""}},
            "the solid turned about the origin, then moved; either may be left out. `rotation` is `{\"axis\": [x, y, "
            "z], \"angle\": degrees}`, right-handed; in two dimensions `{\"angle\": degrees}`, from x towards y"},
           {"ring",
            {solid,
             {"count", WholeNumber{1, 1000}, "", compulsory, ""},
             {"axis", Numbers{just(3)}, "", compulsory, "", 3}},
            "the solid `count` times, evenly about an axis through the origin (in two dimensions without `axis`)"}},
      .may_be_a_file = true};
  return keys;
}

}  // namespace tamp::tools
