#include "runtime/storage/checkpoints/checkpoint.hpp"

#include <array>
#include <fstream>
#include <sstream>

#include "runtime/file_error.hpp"
#include "runtime/storage/checkpoints/sealed_file.hpp"
#include "runtime/storage/hdf5.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/runtime/storage/checkpoints/state_scene.hpp"

namespace
{

namespace fs = std::filesystem;
namespace hdf5 = tamp::runtime::hdf5;
using tamp::test::StateScene, tamp::test::groups;

/// A scene with state of every kind, and a folder with a sound checkpoint of it beside the input.
struct SoundCheckpoint {
  explicit SoundCheckpoint(fs::path in) : folder(std::move(in))
  {
    const std::array<std::byte, 3> host{};
    fs::create_directory(folder);
    scene.fill();
    write_checkpoint(folder, {10, 0.5, "a scene"}, host, scene.warehouse, groups, 1);
  }

  StateScene scene;
  fs::path folder;
};

/// As damage before the file was sealed would, of the first value or of another one.
void change(const hdf5::File& file, const std::string& name, std::size_t index, std::uint64_t value)
{
  const bool is_attribute = H5Aexists(file, name.c_str()) > 0;
  const hdf5::Attribute attribute(is_attribute ? H5Aopen(file, name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID);
  const hdf5::Dataset dataset(is_attribute ? H5I_INVALID_HID : H5Dopen2(file, name.c_str(), H5P_DEFAULT));
  if (attribute < 0 && dataset < 0) return;
  const hdf5::Space space(is_attribute ? H5Aget_space(attribute) : H5Dget_space(dataset));
  const hdf5::Type type(is_attribute ? H5Aget_type(attribute) : H5Dget_type(dataset));
  const std::size_t width = H5Tget_size(type);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * width);
  if (is_attribute) {
    H5Aread(attribute, type, bytes.data());
  } else {
    H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
  for (std::size_t i = 0; i < std::min(width, sizeof value); ++i) {
    if (index * width + i < bytes.size()) bytes[index * width + i] = static_cast<unsigned char>(value >> (8 * i));
  }
  if (is_attribute) {
    H5Awrite(attribute, type, bytes.data());
  } else {
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
}

void change_as_told(const fs::path& checkpoint, const fs::path& changes)
{
  const hdf5::Quiet quiet;
  const hdf5::File file(H5Fopen(checkpoint.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  std::ifstream lines(changes);
  std::string name;
  std::size_t index = 0;
  std::uint64_t value = 0;
  while (lines >> name >> index >> value) change(file, name, index, value);
}

}  // namespace

void tamp::fuzz::checkpoint(const std::filesystem::path& file)
{
  static SoundCheckpoint sound(file.parent_path() / "sound");
  const fs::path folder = file.parent_path() / "damaged", damaged = folder / "step_00000010.h5";
  fs::create_directories(folder);
  std::vector<std::string> refused;
  fs::copy_file(file, damaged, fs::copy_options::overwrite_existing);
  runtime::newest_checkpoint(folder, refused);

  fs::copy_file(sound.folder / "step_00000010.h5", damaged, fs::copy_options::overwrite_existing);
  change_as_told(damaged, file);
  runtime::seal(damaged, {});
  if (const auto found = runtime::newest_checkpoint(folder, refused)) {
    runtime::read_checkpoint(*found, sound.scene.warehouse, groups);
  }
}
