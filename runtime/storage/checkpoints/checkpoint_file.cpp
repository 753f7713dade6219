#include "runtime/storage/checkpoints/checkpoint_file.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <sstream>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/checkpoints/sealed_file.hpp"
#include "runtime/storage/checksum.hpp"
#include "runtime/storage/row_share.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

/// How the values of a table stand in its rows.
struct RowLayout {
  explicit RowLayout(std::size_t value_bytes)
      : type(value_bytes % 8 == 0 ? hdf5::element_type<std::uint64_t>() : hdf5::element_type<std::byte>()),
        n_columns(value_bytes % 8 == 0 ? value_bytes / 8 : value_bytes)
  {
  }

  hdf5::ElementType type;
  hsize_t n_columns;
};

void write_header(const hdf5::OpenFile& file, const CheckpointHeader& header, const PatchLayout& layout,
                  std::span<const std::string> group_names)
{
  const auto as_numbers = [](const Index& index) { return std::array<std::int64_t, 3>{index[0], index[1], index[2]}; };
  file.write_attribute("format", std::span(&checkpoint_format, 1));
  file.write_attribute("step", std::span(&header.step, 1));
  file.write_attribute("time", std::span(&header.time, 1));
  file.write_attribute("fingerprint", header.fingerprint);
  file.write_attribute("patches", as_numbers(layout.n_patches()));
  file.write_attribute("cells", as_numbers(layout.grid().n_cells));
  file.write_attribute("groups", fmt::format("{}", fmt::join(group_names, "\n")));
}

void write_contents(const hdf5::OpenFile& file, std::span<const StateTable> tables)
{
  std::string text;
  for (const StateTable& table : tables) text += fmt::format("{} {}\n", table.value_bytes, table.path);
  file.write_from_first("contents", text);
}

void write_entries(const hdf5::OpenFile& file, const std::string& table, std::span<const PatchEntry> entries)
{
  std::vector<std::uint64_t> numbers;
  for (const PatchEntry& entry : entries) numbers.insert(numbers.end(), {entry.n_values, entry.sum});
  file.write_from_first("by_patch/" + table, {entries.size(), 2}, hdf5::element_type<std::uint64_t>(), numbers.data());
}

void write_values(const hdf5::OpenFile& file, const StateTable& table, std::span<const PatchEntry> entries)
{
  const auto is_own = [&](std::size_t p) { return table.is_written_by(file.communicator(), p); };
  std::vector<std::uint64_t> n_values;
  std::vector<std::byte> own;
  for (std::size_t p = 0; p < entries.size(); ++p) {
    n_values.push_back(entries[p].n_values);
    if (!is_own(p)) continue;
    const std::vector<std::byte> values = table.patches[p].bytes();
    own.insert(own.end(), values.begin(), values.end());
  }
  const RowLayout rows(table.value_bytes);
  const RowShare share = share_by_patch(n_values, is_own);
  hdf5::Share stored{{share.n_total, rows.n_columns}, {}};
  for (const RowRun& run : share.runs) stored.slabs.push_back({{run.first, 0}, {run.n, rows.n_columns}});
  file.write(table.path, stored, rows.type, own.data());
}

/// No less than the file takes.
std::int64_t size_of(std::span<const StateTable> tables, std::span<const std::vector<PatchEntry>> entries,
                     std::size_t n_host)
{
  constexpr std::size_t of_file = 65536, of_table = 16384;
  std::size_t n_bytes = of_file + n_host;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    n_bytes += of_table + tables[t].path.size() + sizeof(PatchEntry) * entries[t].size();
    for (const PatchEntry& entry : entries[t]) n_bytes += tables[t].value_bytes * entry.n_values;
  }
  return static_cast<std::int64_t>(n_bytes);
}

}  // namespace

void write_checkpoint_file(const std::filesystem::path& file, const CheckpointHeader& header,
                           std::span<const std::byte> host, Warehouse& warehouse,
                           std::span<const std::string> group_names, const Communicator& communicator)
{
  const std::vector<StateTable> tables = state_tables(warehouse, group_names);
  const std::vector<std::vector<PatchEntry>> entries = patch_entries(tables, communicator);
  on_first_rank(communicator, [&] {
    hdf5::create_file(file, seal_bytes);
    reserve_room(file, size_of(tables, entries, host.size()));
  });
  const hdf5::OpenFile opened(file, hdf5::OpenFile::Access::write, "cannot be written", communicator);
  write_header(opened, header, warehouse.layout(), group_names);
  write_contents(opened, tables);
  opened.write_from_first("host", {host.size()}, hdf5::element_type<std::byte>(), host.data());
  for (std::size_t t = 0; t < tables.size(); ++t) {
    write_entries(opened, tables[t].path, entries[t]);
    write_values(opened, tables[t], entries[t]);
  }
  opened.agree();
  opened.flush();
  opened.close();
  on_first_rank(communicator, [&] { give_back_room(file, hdf5::used_size(file)); });
  seal(file, communicator);
}

CheckpointReader::CheckpointReader(const std::filesystem::path& file)
    : file_(file, hdf5::OpenFile::Access::read, "cannot be read")
{
  std::int64_t format = 0;
  file_.read_attribute("format", std::span(&format, 1));
  if (format != checkpoint_format) {
    throw FileError(file.string(), fmt::format("is of format {}, this program reads {}", format, checkpoint_format));
  }
  tables_ = read_contents();
}

CheckpointHeader CheckpointReader::header() const
{
  CheckpointHeader header;
  file_.read_attribute("step", std::span(&header.step, 1));
  file_.read_attribute("time", std::span(&header.time, 1));
  header.fingerprint = file_.text_attribute("fingerprint");
  return header;
}

std::vector<std::byte> CheckpointReader::host() const
{
  return file_.read<std::byte>("host");
}

void CheckpointReader::expect(const PatchLayout& layout, std::span<const std::string> group_names) const
{
  const auto compare = [&](const char* what, const std::string& found, const std::string& expected) {
    if (found == expected) return;
    throw FileError(file_.file().string(),
                    fmt::format("is of another scene: {} {}, expected {}", what, found, expected));
  };
  const auto by_axis = [&](const char* what, const Index& expected) {
    std::array<std::int64_t, 3> found{};
    file_.read_attribute(what, found);
    compare(what, fmt::format("{}", fmt::join(found, " x ")), fmt::format("{}", fmt::join(expected, " x ")));
  };
  by_axis("patches", layout.n_patches());
  by_axis("cells", layout.grid().n_cells);
  compare("groups", file_.text_attribute("groups"), fmt::format("{}", fmt::join(group_names, "\n")));
}

std::vector<std::byte> CheckpointReader::read(const Table& table, std::size_t patch) const
{
  const PatchEntry& entry = table.entries[patch];
  const RowLayout rows(table.value_bytes);
  hsize_t first = 0;
  for (std::size_t p = 0; p < patch; ++p) first += table.entries[p].n_values;
  std::vector<std::byte> values(entry.n_values * table.value_bytes);
  file_.read(table.path, {{first, 0}, {entry.n_values, rows.n_columns}}, rows.type, values.data());
  if (checksum(values) != entry.sum) {
    throw FileError(file_.file().string(), fmt::format("is damaged in {} of patch {}", table.path, patch));
  }
  return values;
}

void CheckpointReader::check_share(std::size_t share, std::size_t n_shares) const
{
  std::size_t part = 0;
  for (const Table& table : tables_) {
    for (std::size_t p = 0; p < table.entries.size(); ++p) {
      if (part++ % n_shares == share) read(table, p);
    }
  }
}

std::vector<CheckpointReader::Table> CheckpointReader::read_contents() const
{
  std::vector<Table> tables;
  std::istringstream lines(file_.read_text("contents"));
  Table table;
  while (lines >> table.value_bytes && lines.ignore() && std::getline(lines, table.path)) {
    table.entries = read_entries("by_patch/" + table.path);
    tables.push_back(table);
  }
  return tables;
}

std::vector<PatchEntry> CheckpointReader::read_entries(const std::string& path) const
{
  const auto numbers = file_.read<std::uint64_t>(path);
  std::vector<PatchEntry> entries;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) entries.push_back({numbers[i], numbers[i + 1]});
  return entries;
}

}  // namespace tamp::runtime
