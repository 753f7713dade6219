#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
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

  ElasticPoint at(double elastic, double plastic) const
  {
    const Located here = locate(elastic, plastic);
    const SurfaceNode point = here.patch->at(here.elastic, here.plastic).per(here.per_elastic, here.per_plastic);
    return {point.pressure + point.bulk_modulus * here.beyond, point.bulk_modulus,
            here.held ? 0 : point.coupling + point.modulus_by_plastic * here.beyond};
  }

  double modulus_by_plastic(double elastic, double plastic) const
  {
    const Located here = locate(elastic, plastic);
    const SurfaceNode point = here.patch->at(here.elastic, here.plastic).per(here.per_elastic, here.per_plastic);
    return here.held ? 0 : point.modulus_by_plastic;
  }

  const SurfaceErrors& errors() const { return errors_; }
  const StrainRange& range() const { return range_; }

 private:
  class Refinement;

  static double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

  struct Located {
    const HermitePatch* patch;
    double elastic, plastic;          // in the patch, from 0 to 1
    double per_elastic, per_plastic;  // patches per unit of strain
    double beyond;                    // how far the elastic strain is out of the range
    bool held;                        // whether the plastic strain is
  };
  Located locate(double elastic, double plastic) const
  {
    // In this order a strain that is not a number counts as the least, and ends up in `beyond`.
    const double e = std::min(std::max(range_.least_elastic, elastic), range_.most_elastic);
    const double p = std::min(std::max(range_.least_plastic, plastic), range_.most_plastic);
    const StrainAxis::Section &column = elastic_.section_of(e), &row = plastic_.section_of(p);
    const QuadTree::Place x = place(column, e, elastic_.n_squares()), y = place(row, p, plastic_.n_squares());
    const QuadTree::Leaf leaf = tree_.find(x, y);
    const QuadTree::Place in_leaf = (QuadTree::Place{1} << leaf.side_bits) - 1;
    const double per_side = power_of_two(-leaf.side_bits);
    const double cuts = power_of_two(QuadTree::fraction_bits - leaf.side_bits);
    return {&patches_[static_cast<std::size_t>(leaf.number)],
            static_cast<double>(x & in_leaf) * per_side,
            static_cast<double>(y & in_leaf) * per_side,
            column.squares_per_strain * cuts,
            row.squares_per_strain * cuts,
            elastic - e,
            p != plastic};
  }
  static QuadTree::Place place(const StrainAxis::Section& section, double strain, int n_squares)
  {
    const double square = section.first_square + (strain - section.start) * section.squares_per_strain;
    return std::min(static_cast<QuadTree::Place>(square * power_of_two(QuadTree::fraction_bits)),
                    (QuadTree::Place{n_squares} << QuadTree::fraction_bits) - 1);
  }

  StrainRange range_;
  StrainAxis elastic_, plastic_;
  QuadTree tree_;
  std::vector<HermitePatch> patches_;  // one for each leaf; derivatives per side of the patch
  SurfaceErrors errors_{};
};

}  // namespace tamp::components
