#include "runtime/storage/checkpoints/state_tables.hpp"

#include <algorithm>
#include <map>

#include "runtime/storage/checksum.hpp"

namespace tamp::runtime
{

namespace
{

std::string path_of(const Field& field, std::span<const std::string> group_names)
{
  const std::string kind = std::string(to_string(field.label->centring())) + "s/";
  const std::string& label = field.label->name();
  if (field.group < 0) return "common/" + kind + label;
  return kind + group_names[static_cast<std::size_t>(field.group)] + "/" + label;
}

/// Calls `visit(first byte, number of bytes)` for what lies together in memory, in the order of the values.
template <class Visit>
void for_each_piece(const PatchState& state, Visit&& visit)
{
  const Field& field = *state.field;
  const std::size_t value_bytes = field.label->value_bytes();
  std::byte* const memory = field.previous_buffer.data();
  if (!is_on_grid(field.label->centring())) return visit(memory, field.n_bytes());
  const auto strides = field.box.strides();
  IndexBox starts = state.inside;
  starts.upper[0] = starts.lower[0] + 1;
  for_each(starts, [&](const Index& i) {
    std::ptrdiff_t at = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) at += strides[axis] * (i[axis] - field.box.lower[axis]);
    visit(memory + static_cast<std::size_t>(at) * value_bytes,
          static_cast<std::size_t>(state.inside.extent(0)) * value_bytes);
  });
}

}  // namespace

std::size_t PatchState::n_values() const
{
  return is_on_grid(field->label->centring()) ? static_cast<std::size_t>(inside.size()) : field->n_values();
}

std::vector<std::byte> PatchState::bytes() const
{
  std::vector<std::byte> all;
  all.reserve(n_values() * field->label->value_bytes());
  append_bytes(all);
  return all;
}

void PatchState::append_bytes(std::vector<std::byte>& all) const
{
  for_each_piece(*this, [&](const std::byte* piece, std::size_t n) { all.insert(all.end(), piece, piece + n); });
}

void PatchState::set_bytes(std::span<const std::byte> bytes) const
{
  auto from = bytes.begin();
  for_each_piece(*this, [&](std::byte* piece, std::size_t n) {
    const auto end = from + static_cast<std::ptrdiff_t>(n);
    std::copy(from, end, piece);
    from = end;
  });
}

std::vector<StateTable> state_tables(Warehouse& warehouse, std::span<const std::string> group_names)
{
  const PatchLayout& layout = warehouse.layout();
  std::map<std::string, StateTable> by_path;
  for (Field& field : warehouse.fields()) {
    if (!field.state) continue;
    const std::string path = path_of(field, group_names);
    StateTable& table = by_path[path];
    table.path = path;
    table.value_bytes = field.label->value_bytes();
    if (has_one_value(field.label->centring())) {
      table.is_one_value = true;
      table.patches.push_back({&field, {}});
      continue;
    }
    table.patches.resize(static_cast<std::size_t>(layout.size()));
    const Patch& patch = layout[field.patch];
    if (!warehouse.is_local(patch)) continue;
    const IndexBox& inside = field.label->centring() == Centring::node ? patch.nodes : patch.cells;
    table.patches[static_cast<std::size_t>(patch.id)] = {&field, inside};
  }
  std::vector<StateTable> tables;
  tables.reserve(by_path.size());
  for (auto& [path, table] : by_path) tables.push_back(std::move(table));
  return tables;
}

std::vector<std::byte> StateTable::bytes_written_by(const Communicator& rank) const
{
  std::size_t n = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (is_written_by(rank, p)) n += patches[p].n_values() * value_bytes;
  }
  std::vector<std::byte> all;
  all.reserve(n);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (is_written_by(rank, p)) patches[p].append_bytes(all);
  }
  return all;
}

std::vector<PatchEntry> own_entries(const StateTable& table, const Communicator& communicator)
{
  std::vector<PatchEntry> entries(table.patches.size());
  for (std::size_t p = 0; p < entries.size(); ++p) {
    const PatchState& state = table.patches[p];
    if (table.is_written_by(communicator, p)) entries[p] = {state.n_values(), checksum(state.bytes())};
  }
  return entries;
}

std::vector<CheckpointTable> checkpoint_tables(std::span<const StateTable> tables,
                                               std::span<const std::vector<PatchEntry>> own,
                                               const Communicator& communicator)
{
  std::vector<std::uint64_t> numbers;
  for (const std::vector<PatchEntry>& of_table : own) {
    for (const PatchEntry& entry : of_table) numbers.insert(numbers.end(), {entry.n_values, entry.sum});
  }
  numbers = communicator.sum(std::move(numbers));
  std::vector<CheckpointTable> all;
  std::size_t at = 0;
  for (const StateTable& table : tables) {
    auto& entries = all.emplace_back(CheckpointTable{table.path, table.value_bytes, {}}).entries;
    for (std::size_t p = 0; p < table.patches.size(); ++p, at += 2) entries.push_back({numbers[at], numbers[at + 1]});
  }
  return all;
}

}  // namespace tamp::runtime
