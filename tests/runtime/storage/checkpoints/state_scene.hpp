#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::test
{

using namespace tamp::runtime;

using Point = std::array<double, 2>;
/// A value whose size is no multiple of eight.
using Colour = std::array<unsigned char, 3>;

inline const ParticleLabel<Point, "place"> place;
inline const ParticleLabel<std::int64_t, "number"> number;
inline const ParticleLabel<Colour, "colour"> colour;
inline const CellLabel<double, "warmth"> warmth;
inline const NodeLabel<Point, "drift"> drift;
inline const CellLabel<std::int64_t, "age"> age;
inline const GlobalLabel<Colour, "season"> season;
inline const ReductionLabel<double, "rain"> rain;

inline const std::vector<std::string> groups{"sand", "clay"};

/// State of every kind on a square of 8 x 8 cells, patch p on rank (p + shift) modulo the number of ranks.
struct StateScene {
  explicit StateScene(const Communicator& communicator = {}, int shift = 0, Index n_patches = {2, 2, 1},
                      std::vector<const Label*> state = {&place, &number, &colour, &warmth, &drift, &age, &season,
                                                         &rain})
      : layout(given({{2, {0, 0, 0}, 1, {8, 8, 1}}, n_patches}, communicator.size(), shift)),
        graph({ageing()}, layout, groups, {std::move(state), {}}),
        warehouse(std::vector<const TaskGraph*>{&graph}, communicator.rank())
  {
  }

  static PatchLayout given(PatchLayout layout, int n_ranks, int shift)
  {
    std::vector<int> ranks;
    ranks.reserve(static_cast<std::size_t>(layout.size()));
    for (int p = 0; p < layout.size(); ++p) ranks.push_back((p + shift) % n_ranks);
    layout.give_to_ranks(ranks, n_ranks);
    return layout;
  }

  /// Makes `age` a field of all groups together, with a halo that is no part of the state.
  static TaskDeclaration ageing()
  {
    return task("age").over_patches().reads(age.previous().halo(1)).computes(age).body([](const TaskContext&, auto) {});
  }

  static std::size_t n_particles(int patch, int group) { return static_cast<std::size_t>(patch + 3 * group) % 4; }
  /// Any bits: not-a-numbers with a payload among them.
  static double odd(std::uint64_t n) { return std::bit_cast<double>(n % 2 == 0 ? 0x7ff0dead00000000 + n : ~n); }

  /// Sets all state of this rank to numbers that differ for each place, group and `variant`.
  void fill(int variant = 0)
  {
    if (has_single_values()) {
      warehouse.global_state(season) = {static_cast<unsigned char>(variant), 0xff, 7};
      warehouse.total(rain) = 0.1 * variant;
    }
    for_each_own([&](int patch, int group) {
      warehouse.set_n_particles(patch, group, n_particles(patch, group));
      for (std::size_t p = 0; p < n_particles(patch, group); ++p) {
        const auto n = p + static_cast<std::size_t>(10 * group + 100 * patch + 1000 * variant);
        warehouse.state(place, patch, group)[p] = {odd(n), 0.1 * static_cast<double>(n)};
        warehouse.state(number, patch, group)[p] = static_cast<std::int64_t>(n);
        warehouse.state(colour, patch, group)[p] = {static_cast<unsigned char>(n), 0xff,
                                                    static_cast<unsigned char>(~n)};
      }
      for_each(layout[patch].cells, [&](const Index& i) {
        const int n = i[0] + 8 * i[1] + 64 * group + 1000 * variant;
        warehouse.grid_state(warmth, patch, group)[i] = 0.1 * n;
        warehouse.grid_state(age, patch, -1)[i] = n - 64 * group;
      });
      for_each(layout[patch].nodes, [&](const Index& i) {
        warehouse.grid_state(drift, patch, group)[i] = {1.0 * i[0] + variant, odd(static_cast<std::uint64_t>(i[1]))};
      });
    });
  }

  /// The bytes of all state of this rank.
  std::string bytes()
  {
    std::string all;
    const auto add = [&](const auto& value) { all.append(reinterpret_cast<const char*>(&value), sizeof value); };
    if (has_single_values()) {
      add(warehouse.global_state(season));
      add(warehouse.total(rain));
    }
    for_each_own([&](int patch, int group) {
      for (const Point& x : warehouse.state(place, patch, group)) add(x);
      for (const std::int64_t n : warehouse.state(number, patch, group)) add(n);
      for (const Colour& c : warehouse.state(colour, patch, group)) add(c);
      for_each(layout[patch].cells, [&](const Index& i) {
        add(warehouse.grid_state(warmth, patch, group)[i]);
        add(warehouse.grid_state(age, patch, -1)[i]);
      });
      for_each(layout[patch].nodes, [&](const Index& i) { add(warehouse.grid_state(drift, patch, group)[i]); });
    });
    return all;
  }

  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;

 private:
  bool has_single_values() const
  {
    const auto& uses = graph.label_uses();
    return std::any_of(uses.begin(), uses.end(), [](const LabelUse& use) { return use.label == &season; });
  }
  template <class Visit>
  void for_each_own(Visit&& visit)
  {
    for (const Patch& patch : layout) {
      for (int g = 0; g < 2 && warehouse.is_local(patch); ++g) visit(patch.id, g);
    }
  }
};

}  // namespace tamp::test
