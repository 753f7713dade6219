#include "components/moduli/hermite_surface.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

using Place = QuadTree::Place;

// Narrow in plastic strain, where a cubic is an approximation to p and not to K. Cut in halves they meet the own grid
// of an UnloadingTable.
constexpr int n_elastic_squares = 24, n_plastic_squares = 64;

// Places in a patch, in units of its side.
constexpr std::array<double, 2> at_corners{0, 1};
constexpr std::array<double, 4> refined_with{0.125, 0.375, 0.625, 0.875};
constexpr std::array<double, 7> certified_with{1 / 14.0, 3 / 14.0, 5 / 14.0, 0.5, 9 / 14.0, 11 / 14.0, 13 / 14.0};

/// The ends of the range and the seams inside it.
std::vector<double> lines(double least, double most, std::vector<double> seams)
{
  if (!(least < most)) {
    throw BadValue("strains from " + std::to_string(least) + " to " + std::to_string(most), "a range");
  }
  seams.insert(seams.end(), {least, 0.0, most});
  std::sort(seams.begin(), seams.end());
  std::erase_if(seams, [&](double strain) { return strain < least || strain > most; });
  seams.erase(std::unique(seams.begin(), seams.end()), seams.end());
  return seams;
}

}  // namespace

/// Cuts the squares of a surface until its errors are within the tolerance.
class HermiteSurface::Refinement
{
 public:
  Refinement(HermiteSurface& surface, const SurfaceLine& line, const SurfaceTolerance& tolerance)
      : surface_(surface), tree_(surface.tree_), line_(line), tolerance_(tolerance)
  {
    constexpr Place side = Place{1} << QuadTree::fraction_bits;
    for (int row = 0; row < surface.plastic_.n_squares(); ++row) {
      for (int column = 0; column < surface.elastic_.n_squares(); ++column) {
        add_fresh(squares_.size(), column * side, row * side, QuadTree::fraction_bits);
      }
    }
  }

  void run()
  {
    while (!fresh_.empty()) {
      sample_corners();
      std::vector<std::size_t> failing = failing_alone();
      if (failing.empty()) failing = failing_joined();
      check_can_cut(failing);
      for (const std::size_t i : failing) {
        if (!squares_[i].fresh) cut(i);  // unless it was cut as a neighbour
      }
    }
    surface_.errors_ = errors();
  }

 private:
  struct Error {
    double pressure = 0, bulk_modulus = 0;

    void include(const Error& other)
    {
      pressure = std::max(pressure, other.pressure);
      bulk_modulus = std::max(bulk_modulus, other.bulk_modulus);
    }
    bool within(const SurfaceTolerance& tolerance) const
    {
      return pressure <= tolerance.pressure && bulk_modulus <= tolerance.bulk_modulus;
    }
  };

  static Error error_of(const SurfaceNode& found, const SurfaceNode& exact)
  {
    const double k = std::abs(exact.bulk_modulus), p = std::abs(exact.pressure) + 1e-3 * k;
    const auto number = [](double error) { return std::isnan(error) ? HUGE_VAL : error; };
    return {number(std::abs(found.pressure - exact.pressure) / p),
            number(std::abs(found.bulk_modulus - exact.bulk_modulus) / k)};
  }

  /// A leaf of the tree and what is known of it; its patch has the same number.
  struct Square {
    Place x, y;  // place of the lower left corner
    int side_bits;
    double width, height;                // strains
    std::array<SurfaceNode, 4> exact{};  // at the corners
    Error error{};
    bool certified = false;
    bool fresh = true;

    Place side() const { return Place{1} << side_bits; }
  };

  void add_fresh(std::size_t i, Place x, Place y, int side_bits)
  {
    const auto strain = [&](const StrainAxis& axis, Place corner) {
      const StrainAxis::Section& section = axis.section_of_square(static_cast<double>(corner) * per_square);
      return QuadTree::power_of_two(side_bits - QuadTree::fraction_bits) / section.squares_per_strain;
    };
    if (i == squares_.size()) squares_.emplace_back();
    squares_[i] = {x, y, side_bits, strain(surface_.elastic_, x), strain(surface_.plastic_, y)};
    fresh_.push_back(i);
  }

  static double strain(const StrainAxis& axis, double place)
  {
    const double square = place * per_square;
    const StrainAxis::Section& section = axis.section_of_square(square);
    return section.start + (square - section.first_square) / section.squares_per_strain;
  }

  /// Calls visit(square, place in it, place in it, exact node) for the places `offsets` x `offsets` of each square,
  /// in as few and long lines as there are.
  template <std::size_t N, class Visit>
  void sample(std::vector<std::size_t> squares, const std::array<double, N>& offsets, const Visit& visit) const
  {
    const auto line_of = [&](std::size_t i) { return std::tuple(squares_[i].side_bits, squares_[i].y); };
    std::sort(squares.begin(), squares.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(line_of(a), squares_[a].x) < std::tuple(line_of(b), squares_[b].x);
    });
    const auto place = [](Place corner, double offset, Place side) {
      return static_cast<double>(corner) + offset * static_cast<double>(side);
    };
    std::vector<double> elastic;
    std::vector<SurfaceNode> nodes;
    for (std::size_t first = 0, last = 0; first < squares.size(); first = last) {
      while (last < squares.size() && line_of(squares[last]) == line_of(squares[first])) ++last;
      const Square& any = squares_[squares[first]];
      for (const double s : offsets) {
        elastic.clear();
        for (std::size_t j = first; j < last; ++j) {
          for (const double t : offsets) {
            elastic.push_back(strain(surface_.elastic_, place(squares_[squares[j]].x, t, any.side())));
          }
        }
        nodes.resize(elastic.size());
        line_(strain(surface_.plastic_, place(any.y, s, any.side())), elastic, nodes);
        for (std::size_t k = 0; k < nodes.size(); ++k) visit(squares[first + k / N], offsets[k % N], s, nodes[k]);
      }
    }
  }

  void sample_corners()
  {
    std::sort(fresh_.begin(), fresh_.end());
    fresh_.erase(std::unique(fresh_.begin(), fresh_.end()), fresh_.end());
    sample(fresh_, at_corners, [&](std::size_t i, double t, double s, const SurfaceNode& exact) {
      squares_[i].exact[(t > 0 ? 1 : 0) + (s > 0 ? 2 : 0)] = exact;
    });
    for (const std::size_t i : fresh_) squares_[i].fresh = false;
  }

  /// Makes the patches of all squares. A corner that lies within the edge of a larger square takes its values from that
  /// one's patch, made before, so that the two join.
  void join_patches()
  {
    std::vector<std::size_t> largest_first(squares_.size());
    std::iota(largest_first.begin(), largest_first.end(), std::size_t{0});
    std::sort(largest_first.begin(), largest_first.end(),
              [&](std::size_t a, std::size_t b) { return squares_[a].side_bits > squares_[b].side_bits; });
    surface_.patches_.resize(squares_.size());
    for (const std::size_t i : largest_first) {
      HermitePatch patch{};
      for (std::size_t corner = 0; corner < 4; ++corner) patch.corner[corner] = joined(squares_[i], corner);
      if (patch == surface_.patches_[i]) continue;
      surface_.patches_[i] = patch;
      squares_[i].certified = false;
    }
  }

  /// Calls visit(i) for the squares on the other side of each half of each edge.
  template <class Visit>
  void for_neighbours(const Square& square, const Visit& visit) const
  {
    const Place last = square.side() - 1;
    const auto visit_at = [&](Place x, Place y) {
      if (tree_.contains(x, y)) visit(static_cast<std::size_t>(tree_.find(x, y).number));
    };
    for (const Place along : {Place{0}, last}) {
      visit_at(square.x + along, square.y - 1);
      visit_at(square.x + along, square.y + last + 1);
      visit_at(square.x - 1, square.y + along);
      visit_at(square.x + last + 1, square.y + along);
    }
  }

  SurfaceNode joined(const Square& square, std::size_t corner) const
  {
    const Place x = square.x + (corner % 2 == 1 ? square.side() : 0);
    const Place y = square.y + (corner / 2 == 1 ? square.side() : 0);
    for (const auto& [dx, dy] : {std::pair(-1, -1), std::pair(0, -1), std::pair(-1, 0), std::pair(0, 0)}) {
      if (!tree_.contains(x + dx, y + dy)) continue;
      const auto i = static_cast<std::size_t>(tree_.find(x + dx, y + dy).number);
      const Square& other = squares_[i];
      const Place along = x - other.x, up = y - other.y;
      if (along % other.side() == 0 && up % other.side() == 0) continue;  // a corner of that one too
      const double per_side = QuadTree::power_of_two(-other.side_bits);
      return surface_.patches_[i]
          .at(static_cast<double>(along) * per_side, static_cast<double>(up) * per_side)
          .per(square.width / other.width, square.height / other.height);
    }
    return square.exact[corner].per(square.width, square.height);
  }

  /// Measures squares and returns those whose errors are greater than the tolerance.
  template <std::size_t N, class ErrorAt>
  std::vector<std::size_t> failing_of(const std::vector<std::size_t>& squares, const std::array<double, N>& offsets,
                                      const ErrorAt& error_at)
  {
    for (const std::size_t i : squares) squares_[i].error = {};
    sample(squares, offsets, [&](std::size_t i, double t, double s, const SurfaceNode& exact) {
      squares_[i].error.include(error_at(i, t, s, exact));
    });
    std::vector<std::size_t> failing;
    for (const std::size_t i : squares) {
      if (!squares_[i].error.within(tolerance_)) failing.push_back(i);
    }
    return failing;
  }

  /// Which of the fresh squares miss the tolerance, each looked at by itself. Where smaller squares follow an edge, an
  /// error of pressure on it becomes one of their K, and counts too.
  std::vector<std::size_t> failing_alone()
  {
    return failing_of(std::exchange(fresh_, {}), refined_with,
                      [&](std::size_t i, double t, double s, const SurfaceNode& exact) {
                        const Square& square = squares_[i];
                        HermitePatch patch;
                        for (std::size_t corner = 0; corner < 4; ++corner) {
                          patch.corner[corner] = square.exact[corner].per(square.width, square.height);
                        }
                        const SurfaceNode found = patch.at(t, s).per(1 / square.width, 1 / square.height);
                        Error error = error_of(found, exact);
                        const double followed = 4 * std::abs(found.pressure - exact.pressure) / square.width;
                        error.include({0, followed / std::abs(exact.bulk_modulus)});
                        return error;
                      });
  }

  /// Which squares miss the tolerance after their patches have changed, measured at other points.
  std::vector<std::size_t> failing_joined()
  {
    join_patches();
    std::vector<std::size_t> squares;
    for (std::size_t i = 0; i < squares_.size(); ++i) {
      if (!std::exchange(squares_[i].certified, true)) squares.push_back(i);
    }
    return failing_of(squares, certified_with, [&](std::size_t i, double t, double s, const SurfaceNode& exact) {
      const SurfaceNode found = surface_.patches_[i].at(t, s);
      return error_of(found.per(1 / squares_[i].width, 1 / squares_[i].height), exact);
    });
  }

  SurfaceErrors errors() const
  {
    Error largest;
    for (const Square& square : squares_) largest.include(square.error);
    const std::size_t n = squares_.size();
    return {largest.pressure, largest.bulk_modulus, n * certified_with.size() * certified_with.size(), n};
  }

  void check_can_cut(const std::vector<std::size_t>& squares) const
  {
    const bool too_many = squares_.size() + 3 * squares.size() > most_patches;
    const bool too_small = std::any_of(squares.begin(), squares.end(), [&](std::size_t i) {
      return squares_[i].side_bits == QuadTree::fraction_bits - QuadTree::most_cuts;
    });
    if (!too_many && !too_small) return;
    const auto relative = [](double pressure, double bulk_modulus) {
      std::ostringstream text;
      text << pressure << " of the pressure and " << bulk_modulus << " of the bulk modulus";
      return text.str();
    };
    const SurfaceErrors reached = errors();
    throw BadValue("a surface within " + relative(reached.pressure, reached.bulk_modulus) + " after " +
                       std::to_string(reached.n_patches) + " patches",
                   "one that can be made within " + relative(tolerance_.pressure, tolerance_.bulk_modulus));
  }

  /// Cuts a square in four, and before that the neighbours larger than it: a patch follows its larger neighbour's edge,
  /// and would magnify the errors of one much larger.
  void cut(std::size_t i)
  {
    const Square whole = squares_[i];
    for_neighbours(whole, [&](std::size_t k) {
      if (squares_[k].side_bits > whole.side_bits) cut(k);
    });
    tree_.cut(whole.x, whole.y);
    const Place half = whole.side() / 2;
    add_fresh(i, whole.x, whole.y, whole.side_bits - 1);
    add_fresh(squares_.size(), whole.x + half, whole.y, whole.side_bits - 1);
    add_fresh(squares_.size(), whole.x, whole.y + half, whole.side_bits - 1);
    add_fresh(squares_.size(), whole.x + half, whole.y + half, whole.side_bits - 1);
  }

  static constexpr double per_square = 1.0 / static_cast<double>(Place{1} << QuadTree::fraction_bits);

  HermiteSurface& surface_;
  QuadTree& tree_;
  const SurfaceLine& line_;
  const SurfaceTolerance& tolerance_;
  std::vector<Square> squares_;
  std::vector<std::size_t> fresh_;  // squares not yet sampled
};

HermiteSurface::HermiteSurface(const StrainRange& range, const SurfaceLine& line, const SurfaceTolerance& tolerance,
                               const SurfaceSeams& seams)
    : range_(range),
      elastic_(lines(range.least_elastic, range.most_elastic, seams.elastic), n_elastic_squares),
      plastic_(lines(range.least_plastic, range.most_plastic, seams.plastic), n_plastic_squares),
      tree_(elastic_.n_squares(), plastic_.n_squares())
{
  Refinement(*this, line, tolerance).run();
}

}  // namespace tamp::components
