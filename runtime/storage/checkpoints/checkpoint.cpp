#include "runtime/storage/checkpoints/checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "runtime/file_error.hpp"
#include "runtime/graph/graph_error.hpp"
#include "runtime/ranks/gather_by_patch.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/checkpoints/checkpoint_file.hpp"
#include "runtime/storage/checkpoints/sealed_file.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

namespace fs = std::filesystem;

std::string name_of(std::int64_t step)
{
  return fmt::format("step_{:08}.h5", step);
}

/// The checkpoints of a folder by their steps, the newest first.
std::map<std::int64_t, fs::path, std::greater<>> checkpoints_in(const fs::path& folder)
{
  std::map<std::int64_t, fs::path, std::greater<>> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    long long step = 0;
    const std::string name = entry.path().filename().string();
    if (std::sscanf(name.c_str(), "step_%lld.h5", &step) == 1 && name == name_of(step)) found[step] = entry.path();
  }
  return found;
}

void remove_file(const fs::path& file)
{
  std::error_code error;
  fs::remove(file, error);
  if (error) throw FileError(file.string(), error.message());
}

/// Makes the folder, and clears it of what a program that was killed had begun.
void prepare(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string(), error.message());
  std::vector<fs::path> begun;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".part") begun.push_back(entry.path());
  }
  if (error) throw FileError(folder.string(), error.message());
  for (const fs::path& part : begun) remove_file(part);
}

void remove_outdated(const fs::path& folder, std::int64_t newest, int keep)
{
  int kept = 0;
  for (const auto& [step, file] : checkpoints_in(folder)) {
    if (step > newest || kept == keep) {
      remove_file(file);
    } else {
      ++kept;
    }
  }
}

/// The checkpoint in a file that is as it was written. Throws FileError on all ranks otherwise.
FoundCheckpoint looked_at(const fs::path& file, const Communicator& communicator)
{
  check_seal(file, communicator);
  FoundCheckpoint found{file, {}, {}};
  on_all_ranks(communicator, [&] {
    const CheckpointReader reader(file);
    found.header = reader.header();
    found.host = reader.host();
    reader.check_share(static_cast<std::size_t>(communicator.rank()), static_cast<std::size_t>(communicator.size()));
  });
  return found;
}

/// Throws unless the file has the tables that are expected: those of a warehouse, or what was to be written.
template <class Table>
void expect_tables(const fs::path& file, const std::vector<CheckpointTable>& found, const std::vector<Table>& expected)
{
  const auto text_of = [](const auto& tables, std::size_t i) {
    return i < tables.size() ? fmt::format("{} of {} bytes", tables[i].path, tables[i].value_bytes) : "nothing more";
  };
  for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i) {
    if (text_of(found, i) == text_of(expected, i)) continue;
    throw FileError(file.string(),
                    fmt::format("is of another scene: {}, expected {}", text_of(found, i), text_of(expected, i)));
  }
}

void read_own(const CheckpointReader& reader, const fs::path& file, Warehouse& warehouse,
              std::span<const StateTable> tables)
{
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const CheckpointTable& stored = reader.tables()[t];
    if (stored.entries.size() != tables[t].patches.size()) {
      throw FileError(file.string(), fmt::format("is of another scene: {} patches in {}, expected {}",
                                                 stored.entries.size(), stored.path, tables[t].patches.size()));
    }
    for (std::size_t p = 0; p < tables[t].patches.size(); ++p) {
      const PatchState& state = tables[t].patches[p];
      if (state.field == nullptr) continue;
      const std::size_t n = stored.entries[p].n_values;
      if (state.field->n_particles != nullptr) {
        warehouse.set_n_particles(state.field->patch, state.field->group, n);
      } else if (state.n_values() != n) {
        throw FileError(file.string(), fmt::format("is of another scene: {} values in {} of patch {}, expected {}", n,
                                                   stored.path, p, state.n_values()));
      }
      state.set_bytes(reader.read(stored, p));
    }
  }
}

/// Reads the file back: MPI's file layer does not report every write that the system refuses.
void check_written(const fs::path& file, const CheckpointContents& contents, const Communicator& communicator)
{
  try {
    const FoundCheckpoint found = looked_at(file, communicator);
    on_all_ranks(communicator, [&] {
      expect_tables(file, CheckpointReader(file).tables(), contents.tables);
      // The first rank's bytes are in the file; those of others may differ in the padding between values.
      if (communicator.is_first() && contents.host != found.host) {
        throw FileError(file.string(), "has other bytes of the host");
      }
    });
  } catch (const FileError& error) {
    throw FileError(file.string(), "cannot be written; as it was read back, it " + error.cause);
  }
}

void write_whole(const fs::path& folder, const CheckpointContents& contents,
                 const std::function<OwnRows(std::size_t table)>& rows_of, int keep, const Communicator& communicator)
{
  if (keep < 1) throw std::invalid_argument("a checkpoint that is not to be kept");
  const fs::path file = folder / name_of(contents.header.step);
  fs::path part = file;
  part += ".part";
  on_first_rank(communicator, [&] { prepare(folder); });
  try {
    write_checkpoint_file(part, contents, rows_of, communicator);
    check_written(part, contents, communicator);
    on_first_rank(communicator, [&] { publish_file(part, file); });
  } catch (...) {
    std::error_code is_gone;
    if (communicator.is_first()) fs::remove(part, is_gone);
    throw;
  }
  on_first_rank(communicator, [&] { remove_outdated(folder, contents.header.step, keep); });
}

CheckpointContents contents_of(const CheckpointHeader& header, std::span<const std::byte> host,
                               const PatchLayout& layout, const std::vector<std::string>& group_names,
                               std::vector<CheckpointTable> tables)
{
  return {header,      {host.begin(), host.end()}, layout.n_patches(), layout.grid().n_cells,
          group_names, std::move(tables)};
}

RowShare share_of(const StateTable& table, const CheckpointTable& stored, const Communicator& communicator)
{
  std::vector<std::uint64_t> n_values;
  for (const PatchEntry& entry : stored.entries) n_values.push_back(entry.n_values);
  return share_by_patch(n_values, [&](std::size_t patch) { return table.is_written_by(communicator, patch); });
}

/// The values of all ranks on the first one.
std::vector<std::byte> gathered(std::vector<std::byte> own, const StateTable& table, const CheckpointTable& stored,
                                const PatchLayout& layout, const Communicator& communicator)
{
  if (table.is_one_value) return own;  // the first rank's
  std::vector<std::uint64_t> n_bytes;
  for (const PatchEntry& entry : stored.entries) n_bytes.push_back(entry.n_values * stored.value_bytes);
  return gather_by_patch(std::move(own), n_bytes, layout, communicator);
}

}  // namespace

void write_checkpoint(const fs::path& folder, const CheckpointHeader& header, std::span<const std::byte> host,
                      Warehouse& warehouse, const std::vector<std::string>& group_names, int keep,
                      const Communicator& communicator)
{
  expect_ranks(warehouse.layout(), communicator.size());
  const std::vector<StateTable> tables = state_tables(warehouse, group_names);
  std::vector<std::vector<PatchEntry>> own;
  own.reserve(tables.size());
  for (const StateTable& table : tables) own.push_back(own_entries(table, communicator));
  const CheckpointContents contents =
      contents_of(header, host, warehouse.layout(), group_names, checkpoint_tables(tables, own, communicator));
  const auto rows_of = [&](std::size_t t) -> OwnRows {
    return {share_of(tables[t], contents.tables[t], communicator), tables[t].bytes_written_by(communicator)};
  };
  write_whole(folder, contents, rows_of, keep, communicator);
}

CheckpointCopy copy_checkpoint(const CheckpointHeader& header, std::span<const std::byte> host, Warehouse& warehouse,
                               const std::vector<std::string>& group_names, const ForAll& for_all,
                               const Communicator& communicator)
{
  expect_ranks(warehouse.layout(), communicator.size());
  const std::vector<StateTable> tables = state_tables(warehouse, group_names);
  std::vector<std::vector<PatchEntry>> own(tables.size());
  std::vector<std::vector<std::byte>> bytes(tables.size());
  for_all(static_cast<int>(tables.size()), [&](int i) {
    const auto t = static_cast<std::size_t>(i);
    own[t] = own_entries(tables[t], communicator);
    bytes[t] = tables[t].bytes_written_by(communicator);
  });
  CheckpointCopy copy{
      contents_of(header, host, warehouse.layout(), group_names, checkpoint_tables(tables, own, communicator)),
      std::move(bytes),
      {}};
  for (std::size_t t = 0; t < tables.size(); ++t) {
    copy.bytes[t] =
        gathered(std::move(copy.bytes[t]), tables[t], copy.contents.tables[t], warehouse.layout(), communicator);
  }
  if (!communicator.is_first()) return {};
  const auto n_bytes = std::accumulate(copy.bytes.begin(), copy.bytes.end(), std::size_t{0},
                                       [](std::size_t n, const auto& table) { return n + table.capacity(); });
  copy.held = LedgerHold(warehouse.ledger().copies, n_bytes);
  return copy;
}

void write_checkpoint(const fs::path& folder, CheckpointCopy copy, int keep)
{
  const auto rows_of = [&](std::size_t t) -> OwnRows {
    const std::size_t n = copy.bytes[t].size() / copy.contents.tables[t].value_bytes;
    return {{n, {{0, n}}}, std::move(copy.bytes[t])};
  };
  write_whole(folder, copy.contents, rows_of, keep, {});
}

std::optional<FoundCheckpoint> newest_checkpoint(const fs::path& folder, std::vector<std::string>& refused,
                                                 const Communicator& communicator)
{
  std::string names;
  if (communicator.is_first()) {
    for (const auto& [step, file] : checkpoints_in(folder)) names += file.filename().string() + "\n";
  }
  std::istringstream lines(communicator.gather(names).front());
  for (std::string name; std::getline(lines, name);) {
    try {
      return looked_at(folder / name, communicator);
    } catch (const FileError& error) {
      refused.emplace_back(error.what());
    }
  }
  return std::nullopt;
}

void read_checkpoint(const FoundCheckpoint& found, Warehouse& warehouse, const std::vector<std::string>& group_names,
                     const Communicator& communicator)
{
  expect_ranks(warehouse.layout(), communicator.size());
  const std::vector<StateTable> tables = state_tables(warehouse, group_names);
  on_all_ranks(communicator, [&] {
    const CheckpointReader reader(found.file);
    reader.expect(warehouse.layout(), group_names);
    expect_tables(found.file, reader.tables(), tables);
    read_own(reader, found.file, warehouse, tables);
  });
}

}  // namespace tamp::runtime
