#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "components/moduli/elastic_model.hpp"
#include "components/moduli/hermite_patch.hpp"
#include "components/moduli/quad_tree.hpp"
#include "components/moduli/strain_axis.hpp"

namespace tamp::components
{

/// The surface to be approximated, along one line of equal plastic strain. Elastic strains ascend; equal ones may
/// follow one another.
using SurfaceLine = std::function<void(double plastic, std::span<const double> elastic, std::span<SurfaceNode> nodes)>;

/// Strains at which the surface may have kinks from end to end. Strain zero is one wherever the range has it inside.
struct SurfaceSeams {
  std::vector<double> elastic, plastic;
};

/// How far a HermiteSurface may be from what it approximates; infinity where it does not matter.
///     |error of p| <= pressure (|p| + 1e-3 K),  |error of K| <= bulk_modulus K
struct SurfaceTolerance {
  double pressure;
  double bulk_modulus;
};

/// The largest errors found, in the measures of SurfaceTolerance, over a sample of 49 points in every patch.
struct SurfaceErrors {
  double pressure, bulk_modulus;
  std::size_t n_samples, n_patches;
};

/// A pressure surface p(elastic, plastic) made of bicubic patches, with continuous p, K = dp/d(elastic) and
/// dp/d(plastic), on squares (in units of the range) that are cut in four until the errors are within a tolerance. One
/// state costs the same whatever the surface was made from. Beyond its range it goes on straight in elastic strain, and
/// is held in plastic strain.
class HermiteSurface
{
 public:
  /// Throws BadValue for a range that is empty, and if the tolerance would need more than `most_patches`.
  HermiteSurface(const StrainRange& range, const SurfaceLine& line, const SurfaceTolerance& tolerance,
                 const SurfaceSeams& seams = {});
  static constexpr std::size_t most_patches = std::size_t{1} << 18;

  ElasticPoint at(double elastic, double plastic) const { return point_at(elastic, plastic); }
  ElasticPointOf<Lanes> at(const Lanes& elastic, const Lanes& plastic) const { return point_at(elastic, plastic); }

  double modulus_by_plastic(double elastic, double plastic) const
  {
    const Located<double> here = locate(elastic, plastic);
    return here.held ? 0 : here.point.modulus_by_plastic;
  }

  const SurfaceErrors& errors() const { return errors_; }
  const StrainRange& range() const { return range_; }

 private:
  class Refinement;

  template <class Number>
  struct Located {
    SurfaceNodeOf<Number> point;  // of the range
    Number beyond;                // how far the elastic strain is out of the range
    Mask<Number> held;            // whether the plastic strain is
  };
  template <class Number>
  Located<Number> locate(const Number& elastic, const Number& plastic) const
  {
    // In this order a strain that is not a number counts as the least, and ends up in `beyond`.
    const Number e = lesser_of<Number>(greater_of<Number>(range_.least_elastic, elastic), range_.most_elastic);
    const Number p = lesser_of<Number>(greater_of<Number>(range_.least_plastic, plastic), range_.most_plastic);
    const auto [column, columns_per_strain] = elastic_.square_at(e);
    const auto [row, rows_per_strain] = plastic_.square_at(p);
    const QuadTree::Found<Number> found = tree_.find_points(column, row);
    std::array<const double*, n_lanes_of<Number>> patches;
    for (std::size_t l = 0; l < patches.size(); ++l) patches[l] = &patches_[found.number[l]].corner[0].pressure;
    const auto [a0, a1, a2, a3, b0, b1, b2, b3, c0, c1, c2, c3, d0, d1, d2, d3] = side_by_side<16>(patches);
    const HermitePatchOf<Number> patch{{{{a0, a1, a2, a3}, {b0, b1, b2, b3}, {c0, c1, c2, c3}, {d0, d1, d2, d3}}}};
    return {patch.at(found.x, found.y)
                .per(columns_per_strain * found.leaves_per_square, rows_per_strain * found.leaves_per_square),
            elastic - e, p != plastic};
  }
  template <class Number>
  ElasticPointOf<Number> point_at(const Number& elastic, const Number& plastic) const
  {
    const auto [point, beyond, held] = locate(elastic, plastic);
    const Number coupling = point.coupling + point.modulus_by_plastic * beyond;
    return {point.pressure + point.bulk_modulus * beyond, point.bulk_modulus, select(held, Number(0.0), coupling)};
  }

  StrainRange range_;
  StrainAxis elastic_, plastic_;
  QuadTree tree_;
  std::vector<HermitePatch> patches_;  // one for each leaf; derivatives per side of the patch
  SurfaceErrors errors_{};
};

}  // namespace tamp::components
