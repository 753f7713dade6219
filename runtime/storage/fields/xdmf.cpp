#include "runtime/storage/fields/xdmf.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <vector>

namespace tamp::runtime
{

namespace
{

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string data_item(const XdmfColumn& column, const std::string& items)
{
  const std::size_t n = n_in_file(column.kind);
  return fmt::format(R"(<DataItem Dimensions="{}{}" NumberType="{}" Precision="8" Format="HDF">{}</DataItem>)", items,
                     n == 1 ? "" : fmt::format(" {}", n), column.whole_numbers ? "Int" : "Float",
                     escaped(column.dataset));
}

std::string attribute(const XdmfColumn& column, const std::string& items)
{
  const char* type = column.kind == ColumnKind::scalar   ? "Scalar"
                     : column.kind == ColumnKind::vector ? "Vector"
                                                         : "Tensor6";
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                     escaped(column.name), type, data_item(column, items));
}

/// The first of a list that has as many; of a file without one, which earlier versions wrote, nothing.
std::string first_of(std::span<const XdmfVertices> lists, std::size_t n)
{
  const auto list = std::find_if(lists.begin(), lists.end(), [n](const XdmfVertices& all) { return all.n >= n; });
  if (list == lists.end()) return "";
  return fmt::format(R"(<DataItem ItemType="HyperSlab" Dimensions="{0}">)"
                     R"(<DataItem Dimensions="3 1" NumberType="Int" Format="XML">0 1 {0}</DataItem>{1}</DataItem>)",
                     n, data_item({"", ColumnKind::scalar, true, list->dataset}, fmt::format("{}", list->n)));
}

std::string content_of(const XdmfParticles& particles, std::span<const XdmfVertices> lists)
{
  const std::string n = fmt::format("{}", particles.n);
  std::string text = fmt::format(
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">{}</Topology>\n", n,
      first_of(lists, particles.n));
  for (const XdmfColumn& column : particles.columns) {
    if (column.name == "position") {
      text += fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data_item(column, n));
    }
  }
  for (const XdmfColumn& column : particles.columns) {
    if (column.name != "position") text += attribute(column, n);
  }
  return text;
}

std::string content_of(const XdmfNodes& nodes)
{
  const std::string n = fmt::format("{} {} {}", nodes.n_nodes[2], nodes.n_nodes[1], nodes.n_nodes[0]);
  const auto triple = [](double z, double y, double x) {
    return fmt::format(R"(<DataItem Dimensions="3" NumberType="Float" Precision="8" Format="XML">{} {} {}</DataItem>)",
                       z, y, x);
  };
  std::string text = fmt::format("        <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{}\"/>\n", n);
  text += fmt::format("        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">{}{}</Geometry>\n",
                      triple(nodes.origin[2], nodes.origin[1], nodes.origin[0]),
                      triple(nodes.spacing, nodes.spacing, nodes.spacing));
  for (const XdmfColumn& column : nodes.columns) text += attribute(column, n);
  return text;
}

std::string grid_at(double time, const std::string& name, const std::string& content)
{
  return fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}      </Grid>\n",
                     escaped(name), time, content);
}

}  // namespace

std::string xdmf_text(std::span<const XdmfStep> steps)
{
  // A collection over time for each block, and not the other way round: so readers keep the blocks' names.
  std::vector<std::string> names;
  std::map<std::string, std::string> grids;
  const auto add = [&](const std::string& name, double time, const std::string& grid) {
    if (!grids.contains(name)) names.push_back(name);
    grids[name] += grid_at(time, name, grid);
  };
  std::vector<XdmfVertices> lists;
  for (const XdmfStep& step : steps) {
    if (step.vertices) lists.push_back(*step.vertices);
    for (const XdmfParticles& particles : step.particles) {
      if (particles.n > 0) add(particles.name, step.time, content_of(particles, lists));
    }
    if (step.nodes) add("grid", step.time, content_of(*step.nodes));
  }
  std::string text = "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
  for (const std::string& name : names) {
    text += fmt::format("    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n",
                        escaped(name), grids[name]);
  }
  return text + "  </Domain>\n</Xdmf>\n";
}

}  // namespace tamp::runtime
