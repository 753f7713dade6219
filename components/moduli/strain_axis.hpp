#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "components/lanes.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

/// A side of a rectangle of strains, divided into squares: sections between given strains, each divided evenly.
class StrainAxis
{
 public:
  struct Section {
    double start;
    double squares_per_strain;
    double first_square;
  };

  /// `lines` ascend, two at least. From the first to the last there are about `n_squares`; each section has that number
  /// halved until it is its share, so that cutting squares in halves meets whatever divides it likewise.
  StrainAxis(std::span<const double> lines, int n_squares)
  {
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      const double width = lines[i + 1] - lines[i];
      const long n_halvings = std::lround(portable::log2((lines.back() - lines.front()) / width));
      const int n = n_halvings > 30 ? 1 : std::max(n_squares >> n_halvings, 1);
      sections_.push_back({lines[i], n / width, static_cast<double>(n_squares_)});
      n_squares_ += n;
    }
  }

  /// Strains between the first line and the last, in squares.
  template <class Number>
  struct SquareAt {
    Number square, squares_per_strain;
  };
  template <class Number>
  SquareAt<Number> square_at(const Number& strain) const
  {
    Number start = sections_[0].start, per_strain = sections_[0].squares_per_strain, first = sections_[0].first_square;
    for (std::size_t i = 1; i < sections_.size(); ++i) {
      const Mask<Number> there = strain >= sections_[i].start;
      start = select(there, Number(sections_[i].start), start);
      per_strain = select(there, Number(sections_[i].squares_per_strain), per_strain);
      first = select(there, Number(sections_[i].first_square), first);
    }
    return {first + (strain - start) * per_strain, per_strain};
  }

  const Section& section_of_square(double square) const
  {
    const Section* section = sections_.data();
    while (section != &sections_.back() && square >= section[1].first_square) ++section;
    return *section;
  }

  int n_squares() const { return n_squares_; }

 private:
  std::vector<Section> sections_;
  int n_squares_ = 0;
};

}  // namespace tamp::components
