#include "tools/run/raster.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tamp::tools
{

Raster::Raster(std::array<double, 2> lower, std::array<double, 2> upper, int most)
    : lower_(lower), size_(std::max(upper[0] - lower[0], upper[1] - lower[1]) / most), n_{}
{
  const bool is_box = upper[0] > lower[0] && upper[1] > lower[1];
  if (!is_box || !std::isfinite(size_) || !(size_ > 0)) throw std::out_of_range("the box of a picture");
  for (std::size_t k = 0; k < 2; ++k) {
    n_[k] = std::max(1, static_cast<int>(std::ceil((upper[k] - lower[k]) / size_ - 1e-9)));
  }
  cells_.resize(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]));
}

void Raster::add(std::array<double, 2> position, double reach, double off, int material, double speed)
{
  const std::array<double, 2> at{(position[0] - lower_[0]) / size_, (position[1] - lower_[1]) / size_};
  const double r = std::max(reach / size_, 0.5), z = off / size_;
  // Compared as numbers: a particle may be far outside.
  const auto inside = [&](double place, std::size_t k) {
    return static_cast<int>(std::clamp(place, 0.0, 1.0 * n_[k]));
  };
  for (int j = inside(at[1] - r, 1); j < inside(at[1] + r + 1, 1); ++j) {
    for (int i = inside(at[0] - r, 0); i < inside(at[0] + r + 1, 0); ++i) {
      const double dx = i + 0.5 - at[0], dy = j + 0.5 - at[1], distance = dx * dx + dy * dy + z * z;
      Cell& cell = cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(n_[0]) + static_cast<std::size_t>(i)];
      if (std::max(std::abs(dx), std::abs(dy)) > r || (cell.material != nobody && cell.distance <= distance)) continue;
      cell = {material, speed, distance};
    }
  }
}

}  // namespace tamp::tools
