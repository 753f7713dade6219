#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "runtime/data/buffer.hpp"
#include "runtime/data/label.hpp"
#include "runtime/grid/index_box.hpp"

namespace tamp::runtime
{

/// The buffers that a field may have.
enum class FieldBuffer { previous, current, part };

/// The storage of one label on one patch for one group (or for none: a reduction, a field common to all groups).
struct Field {
  const Label* label = nullptr;
  int patch = 0;
  int group = 0;
  /// Storage of a node or cell field: the patch with the widest halo that any task asks of it.
  IndexBox box;
  /// Particles of this patch and group; null for other centrings.
  const std::size_t* n_particles = nullptr;
  /// Not computed by the step: what it was stays what it is, in one buffer.
  bool carried = false;
  /// Read from the step before, so kept from step to step.
  bool state = false;
  /// Made anew by a step; and of parts that are added up.
  bool computed = false;
  bool accumulated = false;

  Buffer previous_buffer;
  Buffer current_buffer;
  /// Sums of this patch alone, before its neighbours' parts are added.
  Buffer part_buffer;

  const Buffer& buffer(FieldBuffer which) const
  {
    switch (which) {
      case FieldBuffer::previous:
        return previous_buffer;
      case FieldBuffer::current:
        return carried ? previous_buffer : current_buffer;
      case FieldBuffer::part:
        return part_buffer;
    }
    return current_buffer;
  }
  Buffer& buffer(FieldBuffer which) { return const_cast<Buffer&>(std::as_const(*this).buffer(which)); }

  /// Whether all values of a buffer are known to be zero, but for what was filled in from neighbours. So it is at
  /// first; of state, which the host may set, and of what is not on the grid it is never known.
  bool is_zero(FieldBuffer which) const
  {
    return is_on_grid(label->centring()) && !state && !written_[static_cast<std::size_t>(which)];
  }
  void make_zero(FieldBuffer which)
  {
    if (is_zero(which)) return;
    std::byte* const first = buffer(which).data();
    const std::vector<bool>& rows = written_rows_[static_cast<std::size_t>(which)];
    if (rows.empty()) std::memset(first, 0, n_bytes());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (rows[row]) std::memset(first + row * row_bytes(), 0, row_bytes());
    }
    written_[static_cast<std::size_t>(which)] = false;
  }
  /// To be called by whoever writes into a buffer.
  void note_written(FieldBuffer which)
  {
    written_[static_cast<std::size_t>(which)] = true;
    written_rows_[static_cast<std::size_t>(which)].clear();
  }
  /// The rows of a written buffer that may not be zero, from who knows all of them: none at first, to be set.
  std::vector<bool>& only_written_rows(FieldBuffer which)
  {
    std::vector<bool>& rows = written_rows_[static_cast<std::size_t>(which)];
    rows.assign(n_rows(), false);
    return rows;
  }

  /// Gives all buffers back: a field as of new.
  void release()
  {
    for (Buffer* buffer : {&previous_buffer, &current_buffer, &part_buffer}) buffer->release();
    written_ = {};
  }

  /// Makes room for what `only_written_rows` gives, once the box is known, so that no step asks for it.
  void reserve_rows()
  {
    for (std::vector<bool>& rows : written_rows_) rows.reserve(n_rows());
  }

  /// Rows of nodes or cells along the first axis, as they lie in a buffer.
  std::size_t n_rows() const
  {
    return static_cast<std::size_t>(box.extent(1)) * static_cast<std::size_t>(box.extent(2));
  }
  std::size_t row_bytes() const { return static_cast<std::size_t>(box.extent(0)) * label->value_bytes(); }

  std::size_t n_values() const
  {
    if (n_particles != nullptr) return *n_particles;
    return has_one_value(label->centring()) ? 1 : static_cast<std::size_t>(box.size());
  }
  std::size_t n_bytes() const { return n_values() * label->value_bytes(); }

 private:
  std::array<bool, 3> written_{};
  /// Empty where any row may have been.
  std::array<std::vector<bool>, 3> written_rows_;
};

}  // namespace tamp::runtime
