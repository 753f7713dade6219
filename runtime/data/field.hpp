#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
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
  /// Not computed by the step: it keeps its values, in one buffer.
  bool carried = false;
  /// Read from the step before, so kept from step to step.
  bool state = false;
  /// Made anew by a step; and made of parts that are added up.
  bool computed = false;
  bool accumulated = false;

  /// Whether it is known to be zero where nothing is written to it: a node or cell field that is no state, or a patch's
  /// part of a reduction.
  bool tracks_zero = false;
  /// For fields with `tracks_zero`: whether it is stored only from when it is first written to.
  bool on_demand = false;
  /// The zeros that a node or cell field is read from until then.
  const Buffer* zeros = nullptr;

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

  /// The values of a buffer, for reading.
  std::byte* values(FieldBuffer which) const
  {
    const Buffer& own = buffer(which);
    return own.data() == nullptr && zeros != nullptr ? zeros->data() : own.data();
  }
  /// The values of a buffer, for writing. To be called by whoever writes them.
  std::byte* written_values(FieldBuffer which)
  {
    if (on_demand) {
      buffer(which).reserve(n_bytes());
      idle_ = false;
    }
    written_[static_cast<std::size_t>(which)] = true;
    if (written_rows_ != nullptr) rows_of(which).clear();
    return buffer(which).data();
  }

  /// Whether all values of a buffer are known to be zero, but for what was filled in from neighbours; or a part of a
  /// reduction to be neutral. So it is at first; of anything else it is never known.
  bool is_zero(FieldBuffer which) const { return tracks_zero && !written_[static_cast<std::size_t>(which)]; }
  void make_zero(FieldBuffer which)
  {
    if (is_zero(which)) return;
    std::byte* const first = buffer(which).data();
    if (label->centring() == Centring::reduction) {
      label->reduction()->reset(first);
    } else if (written_rows_ == nullptr || rows_of(which).empty()) {
      std::memset(first, 0, n_bytes());
    } else {
      const std::vector<bool>& rows = rows_of(which);
      for (std::size_t row = 0; row < rows.size(); ++row) {
        if (rows[row]) std::memset(first + row * row_bytes(), 0, row_bytes());
      }
    }
    written_[static_cast<std::size_t>(which)] = false;
  }
  /// The rows of a written buffer that may not be zero, for callers that know all of them: none at first, to be set.
  std::vector<bool>& only_written_rows(FieldBuffer which)
  {
    if (written_rows_ == nullptr) written_rows_ = std::make_unique<std::array<std::vector<bool>, 2>>();
    std::vector<bool>& rows = rows_of(which);
    rows.assign(n_rows(), false);
    return rows;
  }

  /// Gives all buffers back: a field as of new.
  void release()
  {
    for (Buffer* buffer : {&previous_buffer, &current_buffer, &part_buffer}) buffer->release();
    written_rows_ = nullptr;
    written_ = {};
  }

  /// Gives back what is stored on demand if nothing has been written to it since the last call.
  void release_if_idle()
  {
    const bool is_zero_now = is_zero(FieldBuffer::current) && is_zero(FieldBuffer::part);
    if (is_zero_now && idle_) release();
    idle_ = is_zero_now;
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
  std::vector<bool>& rows_of(FieldBuffer which) { return (*written_rows_)[which == FieldBuffer::part ? 1 : 0]; }

  std::array<bool, 3> written_{};
  bool idle_ = false;
  /// The written rows of current values and of parts; empty where any row may have been written.
  std::unique_ptr<std::array<std::vector<bool>, 2>> written_rows_;
};

}  // namespace tamp::runtime
