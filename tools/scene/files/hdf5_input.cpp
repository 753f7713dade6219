#include "tools/scene/files/hdf5_input.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/scene/files/hdf5_heaps.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

namespace hdf5 = runtime::hdf5;
using Datatype = hdf5::Handle<H5Tclose>;

/// A damaged file may claim any size: more than this is not tried.
constexpr hsize_t most_numbers = 10'000'000;

hid_t sound(hid_t result, const std::string& place, const std::string& found, const std::string& expected)
{
  if (result < 0) throw InputError({place, found, expected});
  return result;
}

std::vector<std::size_t> extents_of(hid_t space, const std::string& place)
{
  const int n_axes = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(std::max(n_axes, 0)));
  if (n_axes < 0 || (n_axes > 0 && H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0)) {
    throw InputError({place, "extents that cannot be read", "expected numbers or strings"});
  }
  hsize_t n = 1;
  for (const hsize_t size : sizes) {
    if (size > most_numbers || (n *= size) > most_numbers) {
      throw InputError({place, "more than ten million entries", "expected the numbers of a small network"});
    }
  }
  return {sizes.begin(), sizes.end()};
}

std::size_t count(const std::vector<std::size_t>& extents)
{
  std::size_t n = 1;
  for (const std::size_t size : extents) n *= size;
  return n;
}

void check_are_numbers(hid_t type, const std::string& place)
{
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) throw InputError({place, "no numbers", "expected numbers"});
}

void check_finite(const std::vector<double>& numbers, const std::string& place)
{
  const auto bad = std::find_if(numbers.begin(), numbers.end(), [](double x) { return !std::isfinite(x); });
  if (bad == numbers.end()) return;
  throw InputError({place, fmt::format("{} as number {}", *bad, bad - numbers.begin()), "expected finite numbers"});
}

/// Text that ends with its first zero or with its field.
std::string text_of(const char* field, std::size_t size)
{
  return {field, std::find(field, field + size, '\0')};
}

std::vector<std::string> read_variable_texts(hid_t attribute, hid_t type, hid_t space, std::size_t n,
                                             const std::string& place)
{
  std::vector<char*> fields(n);
  sound(H5Aread(attribute, type, fields.data()), place, "text that cannot be read", "expected text");
  std::vector<std::string> texts;
  texts.reserve(n);
  for (const char* field : fields) texts.emplace_back(field == nullptr ? "" : field);
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, fields.data());
  return texts;
}

std::vector<std::string> read_fixed_texts(hid_t attribute, hid_t type, std::size_t n, const std::string& place)
{
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > most_numbers / std::max<std::size_t>(n, 1)) {
    throw InputError({place, fmt::format("text of {} characters", size), "expected text"});
  }
  std::vector<char> fields(n * size);
  sound(H5Aread(attribute, type, fields.data()), place, "text that cannot be read", "expected text");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < n; ++i) texts.push_back(text_of(&fields[i * size], size));
  return texts;
}

hid_t opened(const std::filesystem::path& file)
{
  expect_input_file(file);
  const bool is_hdf5 = H5Fis_hdf5(file.c_str()) > 0;
  if (is_hdf5) expect_sound_heaps(file);
  return sound(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), file.string(),
               is_hdf5 ? "a damaged or truncated HDF5 file" : "no HDF5 file", "expected an HDF5 file");
}

}  // namespace

Hdf5Input::Hdf5Input(const std::filesystem::path& file) : file_(file), id_(opened(file)) {}

std::string Hdf5Input::place(const std::string& object, const std::string& attribute) const
{
  const std::string path = object == "/" ? "" : object;
  return file_.string() + "#" + path + (attribute.empty() ? "" : "/" + attribute);
}

bool Hdf5Input::has_attribute(const std::string& object, const std::string& attribute) const
{
  return H5Aexists_by_name(id_, object.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

hdf5::Attribute Hdf5Input::open(const std::string& object, const std::string& attribute) const
{
  return hdf5::Attribute(sound(H5Aopen_by_name(id_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                               place(object, attribute), "missing", "expected an attribute of this name"));
}

std::vector<std::string> Hdf5Input::texts(const std::string& object, const std::string& attribute) const
{
  const std::string where = place(object, attribute);
  const hdf5::Attribute id = open(object, attribute);
  const Datatype type(sound(H5Aget_type(id), where, "no type", "expected text"));
  if (H5Tget_class(type) != H5T_STRING) throw InputError({where, "no text", "expected text"});
  const hdf5::Space space(sound(H5Aget_space(id), where, "no extents", "expected text"));
  const std::size_t n = count(extents_of(space, where));
  return H5Tis_variable_str(type) > 0 ? read_variable_texts(id, type, space, n, where)
                                      : read_fixed_texts(id, type, n, where);
}

std::optional<std::vector<double>> Hdf5Input::numbers(const std::string& object, const std::string& attribute) const
{
  if (!has_attribute(object, attribute)) return std::nullopt;
  const std::string where = place(object, attribute);
  const hdf5::Attribute id = open(object, attribute);
  check_are_numbers(Datatype(H5Aget_type(id)), where);
  const hdf5::Space space(sound(H5Aget_space(id), where, "no extents", "expected numbers"));
  std::vector<double> numbers(count(extents_of(space, where)));
  sound(H5Aread(id, H5T_NATIVE_DOUBLE, numbers.data()), where, "numbers that cannot be read", "expected numbers");
  check_finite(numbers, where);
  return numbers;
}

Hdf5Array Hdf5Input::dataset(const std::string& path) const
{
  const std::string where = place(path);
  const hdf5::Dataset id(sound(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), where, "missing", "expected a dataset"));
  check_are_numbers(Datatype(H5Dget_type(id)), where);
  const hdf5::Space space(sound(H5Dget_space(id), where, "no extents", "expected numbers"));
  Hdf5Array array{extents_of(space, where), {}};
  array.numbers.resize(count(array.extents));
  sound(H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.numbers.data()), where,
        "numbers that cannot be read", "expected numbers");
  check_finite(array.numbers, where);
  return array;
}

}  // namespace tamp::tools
