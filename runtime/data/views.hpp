#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "runtime/grid/index_box.hpp"

namespace tamp::runtime
{

#ifdef TAMP_CHECKED
inline constexpr bool checked_build = true;
#else
inline constexpr bool checked_build = false;
#endif

/// Data that a task did not declare, caught in the checked build (TAMP_CHECKED).
struct AccessError : std::logic_error {
  using std::logic_error::logic_error;
};

/// A node or cell field as one task may see it: the patch and the halo it declared, no more.
///
/// Values lie x fastest with the strides of the patch's storage, which all fields of one centring on a patch share.
template <class T>
class GridView
{
 public:
  GridView() = default;
  GridView(T* first, const IndexBox& declared, const std::array<std::ptrdiff_t, 3>& strides)
      : first_(first), box_(declared), strides_(strides)
  {
  }

  /// Whether it is of a label that was not declared in this case, see Reference::when.
  bool empty() const { return first_ == nullptr; }
  /// The indices that may be used.
  const IndexBox& box() const { return box_; }
  const std::array<std::ptrdiff_t, 3>& strides() const { return strides_; }
  /// The value at `box().lower`; kernels step from here by `strides()`.
  T* data() const { return first_; }

  T& operator[](const Index& i) const
  {
    if constexpr (checked_build) check(i);
    return first_[(i[0] - box_.lower[0]) + strides_[1] * (i[1] - box_.lower[1]) + strides_[2] * (i[2] - box_.lower[2])];
  }

 private:
  void check(const Index& i) const
  {
    if (box_.contains(i)) return;
    throw AccessError("index (" + std::to_string(i[0]) + ", " + std::to_string(i[1]) + ", " + std::to_string(i[2]) +
                      ") lies outside of the declared halo");
  }

  T* first_ = nullptr;
  IndexBox box_;
  std::array<std::ptrdiff_t, 3> strides_{};
};

/// The views of all groups, for a task that handles all groups of a patch together.
template <class View>
class PerGroup
{
 public:
  static constexpr std::size_t max_groups = 16;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const View& operator[](std::size_t group) const { return views_[group]; }
  auto begin() const { return views_.begin(); }
  auto end() const { return views_.begin() + static_cast<std::ptrdiff_t>(size_); }
  void push_back(const View& view) { views_[size_++] = view; }

 private:
  std::array<View, max_groups> views_{};
  std::size_t size_ = 0;
};

}  // namespace tamp::runtime
