#include "runtime/storage/checkpoint_reader.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <sstream>

#include "runtime/file_error.hpp"
#include "runtime/storage/checkpoint_writer.hpp"
#include "runtime/storage/checksum.hpp"

namespace tamp::runtime
{

namespace
{

hdf5::File open(const std::filesystem::path& file)
{
  const hdf5::Properties access = hdf5::file_access({}, file);
  return hdf5::File(hdf5::checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), file, "cannot be opened"));
}

}  // namespace

CheckpointReader::CheckpointReader(std::filesystem::path file) : file_(std::move(file)), opened_(open(file_))
{
  const std::int64_t format = numbers("format", 1).front();
  if (format != checkpoint_format) {
    throw FileError(file_.string(), fmt::format("is of format {}, this program reads {}", format, checkpoint_format));
  }
  tables_ = read_contents();
}

CheckpointHeader CheckpointReader::header() const
{
  CheckpointHeader header{numbers("step", 1).front(), 0, text("fingerprint")};
  const hdf5::Attribute time(checked(H5Aopen(opened_, "time", H5P_DEFAULT)));
  checked(H5Aread(time, H5T_NATIVE_DOUBLE, &header.time));
  return header;
}

std::vector<std::byte> CheckpointReader::host() const
{
  const hdf5::Dataset dataset(checked(H5Dopen2(opened_, "host", H5P_DEFAULT)));
  const hdf5::Space space(checked(H5Dget_space(dataset)));
  std::vector<std::byte> bytes(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))));
  checked(H5Dread(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()));
  return bytes;
}

void CheckpointReader::expect(const PatchLayout& layout, std::span<const std::string> group_names) const
{
  const auto compare = [&](const char* what, const std::string& found, const std::string& expected) {
    if (found == expected) return;
    throw FileError(file_.string(), fmt::format("is of another scene: {} {}, expected {}", what, found, expected));
  };
  const auto by_axis = [&](const char* what, const Index& expected) {
    compare(what, fmt::format("{}", fmt::join(numbers(what, 3), " x ")), fmt::format("{}", fmt::join(expected, " x ")));
  };
  by_axis("patches", layout.n_patches());
  by_axis("cells", layout.grid().n_cells);
  compare("groups", text("groups"), fmt::format("{}", fmt::join(group_names, "\n")));
}

std::vector<std::byte> CheckpointReader::read(const Table& table, std::size_t patch) const
{
  std::vector<std::byte> values(table.entries[patch].n_values * table.value_bytes);
  hsize_t first = 0;
  for (std::size_t p = 0; p < patch; ++p) first += table.entries[p].n_values;
  const hdf5::Dataset dataset(checked(H5Dopen2(opened_, table.path.c_str(), H5P_DEFAULT)));
  const hdf5::Space in_file(checked(H5Dget_space(dataset)));
  const bool of_words = table.value_bytes % 8 == 0;
  const hsize_t n_columns = table.value_bytes / (of_words ? 8 : 1);
  const hdf5::Slab rows{{first, 0}, {table.entries[patch].n_values, n_columns}};
  const hsize_t n = rows.n[0] * n_columns;
  if (n > 0) {
    checked(hdf5::select(in_file, std::span(&rows, 1)));
    const hdf5::Space in_memory(checked(H5Screate_simple(1, &n, nullptr)));
    const hid_t type = of_words ? H5T_NATIVE_UINT64 : H5T_NATIVE_UINT8;
    checked(H5Dread(dataset, type, in_memory, in_file, H5P_DEFAULT, values.data()));
  }
  if (checksum(values) != table.entries[patch].sum) {
    throw FileError(file_.string(), fmt::format("is damaged in {} of patch {}", table.path, patch));
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

std::vector<std::int64_t> CheckpointReader::numbers(const char* attribute, std::size_t n) const
{
  std::vector<std::int64_t> values(n);
  const hdf5::Attribute opened(checked(H5Aopen(opened_, attribute, H5P_DEFAULT)));
  checked(H5Aread(opened, H5T_NATIVE_INT64, values.data()));
  return values;
}

std::string CheckpointReader::text(const char* attribute) const
{
  const hdf5::Attribute opened(checked(H5Aopen(opened_, attribute, H5P_DEFAULT)));
  const hdf5::Type type(checked(H5Aget_type(opened)));
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(opened, type, text.data()));
  return text.substr(0, text.find('\0'));
}

std::vector<CheckpointReader::Table> CheckpointReader::read_contents() const
{
  const hdf5::Dataset dataset(checked(H5Dopen2(opened_, "contents", H5P_DEFAULT)));
  const hdf5::Type type(checked(H5Dget_type(dataset)));
  std::string text(H5Tget_size(type), '\0');
  checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
  std::vector<Table> tables;
  std::istringstream lines(text.substr(0, text.find('\0')));
  Table table;
  while (lines >> table.value_bytes && lines.ignore() && std::getline(lines, table.path)) {
    table.entries = read_entries("by_patch/" + table.path);
    tables.push_back(table);
  }
  return tables;
}

std::vector<PatchEntry> CheckpointReader::read_entries(const std::string& path) const
{
  const hdf5::Dataset dataset(checked(H5Dopen2(opened_, path.c_str(), H5P_DEFAULT)));
  const hdf5::Space space(checked(H5Dget_space(dataset)));
  std::vector<PatchEntry> entries(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))) / 2);
  checked(H5Dread(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, entries.data()));
  return entries;
}

}  // namespace tamp::runtime
