#include "runtime/storage/checkpoint_writer.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "runtime/ranks/together.hpp"
#include "runtime/storage/dataset_writer.hpp"
#include "runtime/storage/reserve_room.hpp"
#include "runtime/storage/row_share.hpp"
#include "runtime/storage/sealed_file.hpp"
#include "runtime/storage/state_tables.hpp"

namespace tamp::runtime
{

namespace
{

constexpr const char* write_failure = "cannot be written";

StoredType words()
{
  return {H5T_STD_U64LE, H5T_NATIVE_UINT64};
}

StoredType bytes()
{
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
}

/// Fills a file that is open.
class ContentWriter
{
 public:
  ContentWriter(hid_t file, const std::filesystem::path& name, const Communicator& communicator)
      : file_(file), name_(name), communicator_(communicator), datasets_(name, write_failure, communicator)
  {
  }

  void write_attribute(const char* name, std::span<const std::int64_t> values) const
  {
    const hsize_t n = values.size();
    const hdf5::Space space(checked(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr)));
    write_attribute(name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, values.data());
  }
  void write_attribute(const char* name, double value) const
  {
    write_attribute(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, hdf5::Space(checked(H5Screate(H5S_SCALAR))), &value);
  }
  void write_attribute(const char* name, const std::string& value) const
  {
    const hdf5::Type type = text_type(value);
    write_attribute(name, type, type, hdf5::Space(checked(H5Screate(H5S_SCALAR))), value.c_str());
  }

  void write_text(const std::string& name, const std::string& text)
  {
    const hdf5::Type type = text_type(text);
    write_by_first(name, std::array<hsize_t, 1>{1}, {type, type}, text.c_str());
  }
  void write_bytes(const std::string& name, std::span<const std::byte> values)
  {
    write_by_first(name, std::array<hsize_t, 1>{values.size()}, bytes(), values.data());
  }

  void write_table(const StateTable& table, std::span<const PatchEntry> entries)
  {
    write_entries("by_patch/" + table.path, entries);
    const bool of_words = table.value_bytes % 8 == 0;
    const hsize_t n_columns = table.value_bytes / (of_words ? 8 : 1);
    std::vector<std::uint64_t> n_values;
    for (const PatchEntry& entry : entries) n_values.push_back(entry.n_values);
    const auto is_own = [&](const PatchState& state) {
      return state.field != nullptr && (!table.is_global || communicator_.is_first());
    };
    const RowShare share = share_by_patch(n_values, [&](std::size_t p) { return is_own(table.patches[p]); });
    std::vector<hdf5::Slab> slabs;
    for (const RowRun& run : share.runs) slabs.push_back({{run.first, 0}, {run.n, n_columns}});
    std::vector<std::byte> own;
    own.reserve(share.n_own() * table.value_bytes);
    for (const PatchState& state : table.patches) {
      if (!is_own(state)) continue;
      const std::vector<std::byte> values = state.bytes();
      own.insert(own.end(), values.begin(), values.end());
    }
    const std::array<hsize_t, 2> dimensions{share.n_total, n_columns};
    datasets_.write(file_, table.path, dimensions, slabs, of_words ? words() : bytes(), own.data());
  }

  void agree() const { datasets_.agree(); }

 private:
  hid_t checked(hid_t result) const { return hdf5::checked(result, name_, write_failure); }

  /// Of a fixed length, with a zero at its end.
  hdf5::Type text_type(const std::string& text) const
  {
    hdf5::Type type(checked(H5Tcopy(H5T_C_S1)));
    checked(H5Tset_size(type, text.size() + 1));
    return type;
  }

  void write_attribute(const char* name, hid_t in_file, hid_t in_memory, hid_t space, const void* values) const
  {
    const hdf5::Attribute attribute(checked(H5Acreate2(file_, name, in_file, space, H5P_DEFAULT, H5P_DEFAULT)));
    checked(H5Awrite(attribute, in_memory, values));
  }

  void write_by_first(const std::string& name, std::span<const hsize_t> dimensions, StoredType type, const void* values)
  {
    const hdf5::Slab whole{std::vector<hsize_t>(dimensions.size(), 0), {dimensions.begin(), dimensions.end()}};
    const bool anything = std::find(dimensions.begin(), dimensions.end(), 0U) == dimensions.end();
    const std::span<const hdf5::Slab> slabs(&whole, communicator_.is_first() && anything ? 1 : 0);
    datasets_.write(file_, name, dimensions, slabs, type, values);
  }

  void write_entries(const std::string& name, std::span<const PatchEntry> entries)
  {
    std::vector<std::uint64_t> numbers;
    for (const PatchEntry& entry : entries) numbers.insert(numbers.end(), {entry.n_values, entry.sum});
    write_by_first(name, std::array<hsize_t, 2>{entries.size(), 2}, words(), numbers.data());
  }

  hid_t file_;
  const std::filesystem::path& name_;
  const Communicator& communicator_;
  DatasetWriter datasets_;
};

std::string contents_of(std::span<const StateTable> tables)
{
  std::string text;
  for (const StateTable& table : tables) text += fmt::format("{} {}\n", table.value_bytes, table.path);
  return text;
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

/// An empty file with room at its front for the seal.
void begin(const std::filesystem::path& file)
{
  const hdf5::Quiet quiet;
  const hdf5::Properties access = hdf5::file_access({}, file);
  const hdf5::Properties creation(hdf5::checked(H5Pcreate(H5P_FILE_CREATE), file, write_failure));
  hdf5::checked(H5Pset_userblock(creation, seal_bytes), file, write_failure);
  hdf5::File opened(hdf5::checked(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access), file, write_failure));
  hdf5::checked(opened.close(), file, write_failure);
}

std::array<std::int64_t, 3> as_numbers(const Index& index)
{
  return {index[0], index[1], index[2]};
}

}  // namespace

void write_checkpoint_file(const std::filesystem::path& file, const CheckpointHeader& header,
                           std::span<const std::byte> host, Warehouse& warehouse,
                           std::span<const std::string> group_names, const Communicator& communicator)
{
  const std::vector<StateTable> tables = state_tables(warehouse, group_names);
  const std::vector<std::vector<PatchEntry>> entries = patch_entries(tables, communicator);
  by_first(communicator, [&] {
    begin(file);
    reserve_room(file, size_of(tables, entries, host.size()));
  });
  const hdf5::Quiet quiet;
  hdf5::File opened;
  together(communicator, [&] {
    const hdf5::Properties access = hdf5::file_access(communicator, file);
    opened = hdf5::File(hdf5::checked(H5Fopen(file.c_str(), H5F_ACC_RDWR, access), file, write_failure));
  });
  {
    ContentWriter content(opened, file, communicator);
    content.write_attribute("format", std::span(&checkpoint_format, 1));
    content.write_attribute("step", std::span(&header.step, 1));
    content.write_attribute("time", header.time);
    content.write_attribute("fingerprint", header.fingerprint);
    content.write_attribute("patches", as_numbers(warehouse.layout().n_patches()));
    content.write_attribute("cells", as_numbers(warehouse.layout().grid().n_cells));
    content.write_attribute("groups", fmt::format("{}", fmt::join(group_names, "\n")));
    content.write_text("contents", contents_of(tables));
    content.write_bytes("host", host);
    for (std::size_t t = 0; t < tables.size(); ++t) content.write_table(tables[t], entries[t]);
    content.agree();
  }
  together(communicator, [&] { hdf5::checked(H5Fflush(opened, H5F_SCOPE_GLOBAL), file, write_failure); });
  together(communicator, [&] { hdf5::checked(opened.close(), file, write_failure); });
  by_first(communicator, [&] { give_back_room(file, hdf5::used_size(file)); });
  seal(file, communicator);
}

}  // namespace tamp::runtime
