#include "runtime/graph/layered_layout.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>

namespace tamp::runtime
{

namespace
{

constexpr double between_boxes = 22, between_lines = 12, between_rows = 44, margin = 16;
/// How far apart lines meet a box at most, and which share of its width they use.
constexpr double between_ports = 14, share_for_ports = 0.7;
constexpr int n_order_sweeps = 24, n_place_sweeps = 24;
/// Lines should be straighter than boxes are centred.
constexpr double weight_of_line = 3;

/// A box, or the place where an edge passes a row.
struct Slot {
  int row = 0;
  double width = 0;
  bool is_line = false;
  std::vector<int> above, below;
  double x = 0;
};

double mean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Neighbours that want to overlap, and so all get one place: the mean of what they want.
struct Pool {
  double sum;
  double weight;
  std::size_t n;
  double value() const { return sum / weight; }
};

/// The ascending values nearest to those wanted, by weighted least squares: pools of adjacent violators.
std::vector<double> nearest_ascending(const std::vector<double>& wanted, const std::vector<double>& weights)
{
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    pools.push_back({wanted[i] * weights[i], weights[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].value() >= pools.back().value()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().sum + last.sum, pools.back().weight + last.weight, pools.back().n + last.n};
    }
  }
  std::vector<double> values;
  for (const Pool& pool : pools) values.insert(values.end(), pool.n, pool.value());
  return values;
}

class LayeredDrawing
{
 public:
  LayeredDrawing(std::span<const double> widths, double height, std::span<const std::pair<int, int>> edges)
      : height_(height), edges_(edges), n_boxes_(static_cast<int>(widths.size()))
  {
    for (const double width : widths) slots_.push_back({0, width, false, {}, {}, 0});
    choose_rows();
    for (const auto& [from, to] : edges) ways_.push_back(way(from, to));
    order_rows();
    place_slots();
  }

  LayeredLayout finish() const
  {
    LayeredLayout layout;
    double right = 0;
    for (const Slot& s : slots_) right = std::max(right, s.x + s.width / 2);
    for (int i = 0; i < n_boxes_; ++i) layout.boxes.push_back({slot(i).x, top_of(slot(i).row), slot(i).row});
    for (const std::vector<int>& slots : ways_) layout.routes.push_back(route(slots));
    layout.width = right + margin;
    layout.height = rows_.empty() ? 2 * margin : top_of(static_cast<int>(rows_.size()) - 1) + height_ + margin;
    return layout;
  }

 private:
  Slot& slot(int i) { return slots_[static_cast<std::size_t>(i)]; }
  const Slot& slot(int i) const { return slots_[static_cast<std::size_t>(i)]; }
  double top_of(int row) const { return margin + row * (height_ + between_rows); }

  /// A row below the last of all that lead to a box.
  void choose_rows()
  {
    std::vector<std::pair<int, int>> by_start(edges_.begin(), edges_.end());
    std::sort(by_start.begin(), by_start.end());
    for (const auto& [from, to] : by_start) slot(to).row = std::max(slot(to).row, slot(from).row + 1);
  }

  /// The slots by which an edge goes.
  std::vector<int> way(int from, int to)
  {
    std::vector<int> slots{from};
    for (int row = slot(from).row + 1; row < slot(to).row; ++row) slots.push_back(line_slot(from, row));
    slots.push_back(to);
    for (std::size_t k = 1; k < slots.size(); ++k) join(slots[k - 1], slots[k]);
    return slots;
  }

  int line_slot(int from, int row)
  {
    const auto [found, fresh] = line_slots_.try_emplace({from, row}, static_cast<int>(slots_.size()));
    if (fresh) slots_.push_back({row, between_lines, true, {}, {}, 0});
    return found->second;
  }

  void join(int upper, int lower)
  {
    std::vector<int>& below = slot(upper).below;
    if (std::find(below.begin(), below.end(), lower) != below.end()) return;
    below.push_back(lower);
    slot(lower).above.push_back(upper);
  }

  /// By turns from above and from below each row is sorted by the mean places of the neighbours; of all the orders that
  /// come up the one with the fewest crossings stays.
  void order_rows()
  {
    for (int i = 0; i < static_cast<int>(slots_.size()); ++i) {
      const auto row = static_cast<std::size_t>(slot(i).row);
      if (rows_.size() <= row) rows_.resize(row + 1);
      rows_[row].push_back(i);
    }
    auto best = rows_;
    std::size_t fewest = n_crossings();
    for (int sweep = 0; sweep < n_order_sweeps && fewest > 0; ++sweep) {
      for_each_row(sweep % 2 == 0, [&](std::vector<int>& row, bool from_above) { sort_row(row, from_above); });
      if (const std::size_t n = n_crossings(); n < fewest) {
        fewest = n;
        best = rows_;
      }
    }
    rows_ = std::move(best);
  }

  template <class Visit>
  void for_each_row(bool downwards, Visit&& visit)
  {
    for (std::size_t k = 0; k < rows_.size(); ++k) visit(rows_[downwards ? k : rows_.size() - 1 - k], downwards);
  }

  std::vector<double> places() const
  {
    std::vector<double> place(slots_.size());
    for (const std::vector<int>& row : rows_) {
      for (std::size_t k = 0; k < row.size(); ++k) place[static_cast<std::size_t>(row[k])] = static_cast<double>(k);
    }
    return place;
  }

  void sort_row(std::vector<int>& row, bool from_above)
  {
    const std::vector<double> place = places();
    std::map<int, double> wanted;
    for (const int i : row) {
      std::vector<double> near;
      for (const int other : from_above ? slot(i).above : slot(i).below)
        near.push_back(place[static_cast<std::size_t>(other)]);
      wanted[i] = near.empty() ? place[static_cast<std::size_t>(i)] : mean(near);
    }
    std::stable_sort(row.begin(), row.end(), [&](int a, int b) { return wanted[a] < wanted[b]; });
  }

  std::size_t n_crossings() const
  {
    const std::vector<double> place = places();
    std::size_t n = 0;
    for (const std::vector<int>& row : rows_) {
      std::vector<std::pair<double, double>> lines;
      for (const int i : row) {
        for (const int other : slot(i).below) {
          lines.emplace_back(place[static_cast<std::size_t>(i)], place[static_cast<std::size_t>(other)]);
        }
      }
      for (std::size_t a = 0; a < lines.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          n += std::size_t{(lines[a].first - lines[b].first) * (lines[a].second - lines[b].second) < 0};
        }
      }
    }
    return n;
  }

  /// Each slot as near to the middle of its neighbours as those beside it leave room for.
  void place_slots()
  {
    for (int sweep = 0; sweep < n_place_sweeps; ++sweep) {
      const bool last = sweep + 2 >= n_place_sweeps;
      for_each_row(sweep % 2 == 0, [&](std::vector<int>& row, bool from_above) {
        place_row(row, last || from_above, last || !from_above);
      });
    }
    double left = 0;
    for (const Slot& s : slots_) left = std::min(left, s.x - s.width / 2);
    for (Slot& s : slots_) s.x += margin - left;
  }

  double wanted_place(const Slot& s, bool from_above, bool from_below) const
  {
    std::vector<double> near;
    if (from_above)
      std::transform(s.above.begin(), s.above.end(), std::back_inserter(near), [&](int i) { return slot(i).x; });
    if (from_below)
      std::transform(s.below.begin(), s.below.end(), std::back_inserter(near), [&](int i) { return slot(i).x; });
    return near.empty() ? s.x : mean(near);
  }

  void place_row(const std::vector<int>& row, bool from_above, bool from_below)
  {
    std::vector<double> wanted, weights, offsets;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Slot& s = slot(row[k]);
      offsets.push_back(k == 0 ? 0 : offsets.back() + distance(slot(row[k - 1]), s));
      wanted.push_back(wanted_place(s, from_above, from_below) - offsets.back());
      weights.push_back(s.is_line ? weight_of_line : 1);
    }
    const std::vector<double> shifts = nearest_ascending(wanted, weights);
    for (std::size_t k = 0; k < row.size(); ++k) slot(row[k]).x = shifts[k] + offsets[k];
  }

  static double distance(const Slot& a, const Slot& b)
  {
    const bool lines = a.is_line && b.is_line;
    return (a.width + b.width) / 2 + (lines ? 0 : between_boxes);
  }

  Route route(const std::vector<int>& slots) const
  {
    const Slot& start = slot(slots.front());
    Route points{{start.x, top_of(start.row) + height_}};
    for (std::size_t k = 1; k + 1 < slots.size(); ++k) {
      const Slot& passed = slot(slots[k]);
      points.push_back({passed.x, top_of(passed.row)});
      points.push_back({passed.x, top_of(passed.row) + height_});
    }
    const Slot& end = slot(slots.back());
    points.push_back({port(end, slots[slots.size() - 2]), top_of(end.row)});
    return points;
  }

  /// Lines meet a box side by side, in the order in which they come.
  double port(const Slot& box, int from) const
  {
    std::vector<int> above = box.above;
    std::sort(above.begin(), above.end(), [&](int a, int b) { return slot(a).x < slot(b).x; });
    const double n = static_cast<double>(above.size());
    const double step = std::min(between_ports, share_for_ports * box.width / n);
    const auto place = static_cast<double>(std::find(above.begin(), above.end(), from) - above.begin());
    return box.x + step * (place - (n - 1) / 2);
  }

  double height_;
  std::span<const std::pair<int, int>> edges_;
  int n_boxes_;
  std::vector<Slot> slots_;
  std::map<std::pair<int, int>, int> line_slots_;
  std::vector<std::vector<int>> ways_;
  std::vector<std::vector<int>> rows_;
};

}  // namespace

LayeredLayout lay_out(std::span<const double> widths, double height, std::span<const std::pair<int, int>> edges)
{
  return LayeredDrawing(widths, height, edges).finish();
}

}  // namespace tamp::runtime
