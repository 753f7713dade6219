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

void write_header(const hdf5::OpenFile& file, const CheckpointContents& contents)
{
  const auto as_numbers = [](const Index& index) { return std::array<std::int64_t, 3>{index[0], index[1], index[2]}; };
  file.write_attribute("format", std::span(&checkpoint_format, 1));
  file.write_attribute("step", std::span(&contents.header.step, 1));
  file.write_attribute("time", std::span(&contents.header.time, 1));
  file.write_attribute("fingerprint", contents.header.fingerprint);
  file.write_attribute("patches", as_numbers(contents.n_patches));
  file.write_attribute("cells", as_numbers(contents.n_cells));
  file.write_attribute("groups", fmt::format("{}", fmt::join(contents.group_names, "\n")));
}

void write_contents(const hdf5::OpenFile& file, std::span<const CheckpointTable> tables)
{
  std::string text;
  for (const CheckpointTable& table : tables) text += fmt::format("{} {}\n", table.value_bytes, table.path);
  file.write_from_first("contents", text);
}

void write_entries(const hdf5::OpenFile& file, const CheckpointTable& table)
{
  std::vector<std::uint64_t> numbers;
  for (const PatchEntry& entry : table.entries) numbers.insert(numbers.end(), {entry.n_values, entry.sum});
  file.write_from_first("by_patch/" + table.path, {table.entries.size(), 2}, hdf5::element_type<std::uint64_t>(),
                        numbers.data());
}

void write_values(const hdf5::OpenFile& file, const CheckpointTable& table, const OwnRows& own)
{
  const RowLayout rows(table.value_bytes);
  hdf5::Share stored{{own.share.n_total, rows.n_columns}, {}};
  for (const RowRun& run : own.share.runs) stored.slabs.push_back({{run.first, 0}, {run.n, rows.n_columns}});
  file.write(table.path, stored, rows.type, own.bytes.data());
}

/// No less than the file takes.
std::int64_t size_of(const CheckpointContents& contents)
{
  constexpr std::size_t of_file = 65536, of_table = 16384;
  std::size_t n_bytes = of_file + contents.host.size();
  for (const CheckpointTable& table : contents.tables) {
    n_bytes += of_table + table.path.size() + sizeof(PatchEntry) * table.entries.size();
    for (const PatchEntry& entry : table.entries) n_bytes += table.value_bytes * entry.n_values;
  }
  return static_cast<std::int64_t>(n_bytes);
}

}  // namespace

void write_checkpoint_file(const std::filesystem::path& file, const CheckpointContents& contents,
                           const std::function<OwnRows(std::size_t table)>& rows_of, const Communicator& communicator)
{
  on_first_rank(communicator, [&] {
    hdf5::create_file(file, seal_bytes);
    reserve_room(file, size_of(contents));
  });
  const hdf5::OpenFile opened(file, hdf5::OpenFile::Access::write, "cannot be written", communicator);
  write_header(opened, contents);
  write_contents(opened, contents.tables);
  opened.write_from_first("host", {contents.host.size()}, hdf5::element_type<std::byte>(), contents.host.data());
  for (std::size_t t = 0; t < contents.tables.size(); ++t) {
    write_entries(opened, contents.tables[t]);
    write_values(opened, contents.tables[t], rows_of(t));
  }
  opened.agree();
  opened.flush();
  opened.close();
  on_first_rank(communicator, [&] { release_room(file, hdf5::used_size(file)); });
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

std::vector<std::byte> CheckpointReader::read(const CheckpointTable& table, std::size_t patch) const
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
  for (const CheckpointTable& table : tables_) {
    for (std::size_t p = 0; p < table.entries.size(); ++p) {
      if (part++ % n_shares == share) read(table, p);
    }
  }
}

std::vector<CheckpointTable> CheckpointReader::read_contents() const
{
  std::vector<CheckpointTable> tables;
  std::istringstream lines(file_.read_text("contents"));
  CheckpointTable table;
  while (lines >> table.value_bytes && lines.ignore() && std::getline(lines, table.path)) {
    table.entries = read_entries("by_patch/" + table.path);
    expect_rows(table);
    tables.push_back(table);
  }
  return tables;
}

void CheckpointReader::expect_rows(const CheckpointTable& table) const
{
  const std::vector<hsize_t> rows = file_.info(table.path).dimensions;
  bool fit = rows.size() == 2 && rows[1] == RowLayout(table.value_bytes).n_columns;
  hsize_t n_left = fit ? rows[0] : 0;
  for (const PatchEntry& entry : table.entries) {
    fit = fit && entry.n_values <= n_left;
    n_left -= fit ? entry.n_values : 0;
  }
  if (!fit || n_left > 0) {
    throw FileError(file_.file().string(), fmt::format("is damaged in how many values {} has", table.path));
  }
}

std::vector<PatchEntry> CheckpointReader::read_entries(const std::string& path) const
{
  const auto numbers = file_.read<std::uint64_t>(path);
  std::vector<PatchEntry> entries;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) entries.push_back({numbers[i], numbers[i + 1]});
  return entries;
}

}  // namespace tamp::runtime
