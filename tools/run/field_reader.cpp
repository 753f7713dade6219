#include "tools/run/field_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/file_error.hpp"

namespace tamp::tools
{

namespace
{

namespace hdf5 = runtime::hdf5;

/// Particles that are read at once.
constexpr hsize_t most_at_once = 1 << 17;

/// How many vectors a dataset holds.
hsize_t n_vectors(const hdf5::OpenFile& file, const std::string& path)
{
  const std::vector<hsize_t> dimensions = file.info(path).dimensions;
  if (dimensions.size() == 2 && dimensions[1] == 3) return dimensions[0];
  throw runtime::FileError(file.file(), fmt::format("is damaged: {} holds no vectors", path));
}

std::vector<double> vectors(const hdf5::OpenFile& file, const std::string& path, hsize_t first, hsize_t n)
{
  std::vector<double> values(3 * n);
  file.read(path, {{first, 0}, {n, 3}}, hdf5::element_type<double>(), values.data());
  return values;
}

}  // namespace

FieldReader::FieldReader(const std::filesystem::path& field_file)
    : file_(field_file, hdf5::OpenFile::Access::read, "cannot read fields"),
      outputs_(file_.members(hdf5::MemberOrder::by_name))
{
  std::erase_if(outputs_, [](const std::string& name) { return !name.starts_with("step_"); });
  // Numbers beyond eight digits are longer.
  std::ranges::sort(outputs_, {}, [](const std::string& name) { return std::pair(name.size(), name); });
}

double FieldReader::time(const std::string& output) const
{
  std::array<double, 1> time{};
  file_.group(output).read_attribute("time", time);
  return time[0];
}

std::vector<std::string> FieldReader::materials(const std::string& output) const
{
  return file_.group(output + "/particles").members(hdf5::MemberOrder::by_name);
}

void FieldReader::for_each(const std::string& output, const std::string& material,
                           const std::function<void(const StoredParticle&)>& look) const
{
  const std::string folder = fmt::format("{}/particles/{}", output, material);
  const std::vector<std::string> fields = file_.group(folder).members(hdf5::MemberOrder::by_name);
  const std::string positions = folder + "/position", velocities = folder + "/velocity";
  const bool has_velocity = std::ranges::find(fields, "velocity") != fields.end();
  const hsize_t n = n_vectors(file_, positions);
  if (has_velocity && n_vectors(file_, velocities) != n) {
    throw runtime::FileError(file_.file(),
                             fmt::format("is damaged: {} has not as many velocities as positions", folder));
  }
  for (hsize_t first = 0; first < n; first += most_at_once) {
    const hsize_t n_here = std::min(most_at_once, n - first);
    const std::vector<double> x = vectors(file_, positions, first, n_here);
    const std::vector<double> v = has_velocity
                                      ? vectors(file_, velocities, first, n_here)
                                      : std::vector<double>(x.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < x.size(); i += 3) {
      const StoredParticle particle{Eigen::Vector3d::Map(&x[i]), Eigen::Vector3d::Map(&v[i])};
      if (particle.position.allFinite()) look(particle);
    }
  }
}

}  // namespace tamp::tools
