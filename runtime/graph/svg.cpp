#include "runtime/graph/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "runtime/graph/dump.hpp"
#include "runtime/graph/layered_layout.hpp"

namespace tamp::runtime
{

namespace
{

constexpr double box_height = 38;
/// Widths of a letter in the two sizes of text, wider than most fonts have them; and the margins beside the text.
constexpr double letter = 7.4, small_letter = 6.3, beside_text = 26;

constexpr const char* drawing_style = R"(<style>
.task-graph { --paper: #ffffff; --ink: #1c1d1f; --faint: #5a5e66; --box: #edf1f6; --declared: #0b4fae; --message: #b84a00;
  background: var(--paper); font-family: system-ui, 'DejaVu Sans', Verdana, sans-serif; }
@media (prefers-color-scheme: dark) { .task-graph { --paper: #15171a; --ink: #e4e5e7; --faint: #a5aab3; --box: #20252c;
  --declared: #5aa0ff; --message: #ff9440; } }
@media print { .task-graph { --paper: #ffffff; --ink: #1c1d1f; --faint: #5a5e66; --box: #edf1f6; --declared: #0b4fae;
  --message: #b84a00; } }
.task-graph rect { fill: var(--box); stroke: var(--declared); stroke-width: 1.4; }
.task-graph .own rect { fill: var(--paper); stroke: var(--faint); stroke-width: 1; }
.task-graph .message rect { fill: var(--paper); stroke: var(--message); stroke-dasharray: 5 3; }
.task-graph text { text-anchor: middle; fill: var(--ink); font-size: 13px; }
.task-graph .small { fill: var(--faint); font-size: 11px; }
.task-graph .line { fill: none; stroke: var(--faint); stroke-width: 1.1; }
.task-graph .head { fill: var(--faint); }
.task-graph .message .line { stroke: var(--message); stroke-dasharray: 5 3; }
.task-graph .message .head { fill: var(--message); }
.task-graph .hit { fill: none; stroke: transparent; stroke-width: 9; }
</style>
)";

double n_letters(const std::string& text)
{
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool is_of_message(InstanceKind kind)
{
  return kind == InstanceKind::send_message || kind == InstanceKind::receive_message;
}

const char* class_of(InstanceKind kind)
{
  if (kind == InstanceKind::body) return "declared";
  return is_of_message(kind) ? "message" : "own";
}

std::string second_line(const TaskGraph& graph, const FoldedTask& task)
{
  std::string text = fmt::format("{} ×", task.instances.size());
  if (task.groups.size() > 3) return text + fmt::format(" {} groups", task.groups.size());
  for (const int group : task.groups) {
    text += (group == task.groups.front() ? " " : ", ") + graph.group_names()[static_cast<std::size_t>(group)];
  }
  return text;
}

double width_of(const TaskGraph& graph, const FoldedTask& task)
{
  return std::max(letter * n_letters(task.name), small_letter * n_letters(second_line(graph, task))) + beside_text;
}

std::string byte_text(std::size_t bytes)
{
  double n = static_cast<double>(bytes);
  const std::array units{"B", "kB", "MB", "GB"};
  std::size_t unit = 0;
  for (; n >= 1000 && unit + 1 < units.size(); ++unit) n /= 1000;
  return fmt::format("{:.3g} {}", n, units[unit]);
}

/// The tooltip of an edge: what it is for, a line for each label.
std::string title_of(const FoldedGraph& folded, const FoldedEdge& edge)
{
  const auto name = [&](int task) { return folded.tasks[static_cast<std::size_t>(task)].name; };
  std::string title = name(edge.from) + " → " + name(edge.to);
  for (const FoldedLabel& l : edge.labels) {
    title +=
        fmt::format("\n{}{}: {} edges", l.label->name(), l.halo > 0 ? fmt::format(", halo {}", l.halo) : "", l.n_edges);
    if (l.bytes > 0) title += ", " + byte_text(l.bytes);
    if (l.n_crossing > 0) title += fmt::format(", {} from rank to rank", l.n_crossing);
  }
  return title;
}

std::string path_of(const Route& route)
{
  std::string path = fmt::format("M{:.1f} {:.1f}", route.front().x, route.front().y);
  for (std::size_t k = 1; k < route.size(); ++k) {
    const Point &a = route[k - 1], &b = route[k];
    const double middle = (a.y + b.y) / 2;
    path += k % 2 == 0 ? fmt::format("V{:.1f}", b.y)
                       : fmt::format("C{:.1f} {:.1f} {:.1f} {:.1f} {:.1f} {:.1f}", a.x, middle, b.x, middle, b.x, b.y);
  }
  return path;
}

/// At the lower end of a route, or for an edge against the order of its tasks at the upper one.
std::string head_of(const Route& route, bool upwards)
{
  const Point tip = upwards ? route.front() : route.back();
  return fmt::format("M{:.1f} {:.1f}l-3.5 {} h7z", tip.x, tip.y, upwards ? 8 : -8);
}

std::string drawn_edge(const FoldedGraph& folded, std::size_t i, const Route& route)
{
  const FoldedEdge& edge = folded.edges[i];
  const std::string path = path_of(route);
  return fmt::format(
      "<g class=\"edge{}\" data-edge=\"{}\" data-from=\"{}\" data-to=\"{}\"><title>{}</title><path class=\"hit\" "
      "d=\"{}\"/>"
      "<path class=\"line\" d=\"{}\"/><path class=\"head\" d=\"{}\"/></g>\n",
      edge.crosses() ? " message" : "", i, edge.from, edge.to, in_markup(title_of(folded, edge)), path, path,
      head_of(route, edge.from > edge.to));
}

std::string drawn_task(const TaskGraph& graph, const FoldedTask& task, std::size_t i, const LaidBox& box)
{
  const double width = width_of(graph, task);
  return fmt::format(
      "<g class=\"task {}\" data-task=\"{}\"><title>{} ({})</title>"
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" rx=\"{}\"/>"
      "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text><text class=\"small\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text></g>\n",
      class_of(task.kind), i, in_markup(task.name), to_string(task.kind), box.x - width / 2, box.top, width, box_height,
      task.kind == InstanceKind::body ? 3.0 : box_height / 2, box.x, box.top + 17, in_markup(task.name), box.x,
      box.top + 31, in_markup(second_line(graph, task)));
}

}  // namespace

std::string in_markup(const std::string& text)
{
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        // XML has no other control characters.
        safe += static_cast<unsigned char>(c) < ' ' && c != '\n' ? ' ' : c;
    }
  }
  return safe;
}

std::string to_svg(const TaskGraph& graph, const FoldedGraph& folded)
{
  std::vector<double> widths;
  for (const FoldedTask& task : folded.tasks) widths.push_back(width_of(graph, task));
  std::vector<std::pair<int, int>> ends;
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < folded.edges.size(); ++i) {
    const FoldedEdge& edge = folded.edges[i];
    if (edge.from == edge.to) continue;
    ends.emplace_back(std::minmax({edge.from, edge.to}));
    drawn.push_back(i);
  }
  const LayeredLayout layout = lay_out(widths, box_height, ends);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"task-graph\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n",
      layout.width, layout.height);
  svg += drawing_style;
  for (std::size_t k = 0; k < drawn.size(); ++k) svg += drawn_edge(folded, drawn[k], layout.routes[k]);
  for (std::size_t i = 0; i < folded.tasks.size(); ++i) svg += drawn_task(graph, folded.tasks[i], i, layout.boxes[i]);
  return svg + "</svg>\n";
}

}  // namespace tamp::runtime
