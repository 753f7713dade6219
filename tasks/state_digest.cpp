#include "tasks/state_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tasks/labels.hpp"

namespace tamp::tasks
{

namespace
{

struct Place {
  std::int64_t id;
  int patch;
  int group;
  std::size_t particle;
};

std::vector<Place> places_by_id(runtime::Warehouse& warehouse)
{
  std::vector<Place> places;
  for (const runtime::Patch& patch : warehouse.layout()) {
    for (int g = 0; g < warehouse.n_groups(); ++g) {
      const auto ids = warehouse.state(particle::id, patch.id, g);
      for (std::size_t p = 0; p < ids.size(); ++p) places.push_back({ids[p], patch.id, g, p});
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
  return places;
}

class Fnv1a
{
 public:
  void add(const std::byte* first, std::size_t n)
  {
    for (std::size_t i = 0; i < n; ++i) hash_ = (hash_ ^ std::to_integer<std::uint64_t>(first[i])) * 0x100000001b3U;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace

std::string state_digest(runtime::Warehouse& warehouse)
{
  Fnv1a hash;
  for (const Place& place : places_by_id(warehouse)) {
    // Fields of a patch and group come sorted by the names of their labels.
    for (const runtime::Field* field : warehouse.particle_fields(place.patch, place.group)) {
      const std::size_t size = field->label->value_bytes();
      if (field->state) hash.add(field->previous_buffer.data() + place.particle * size, size);
    }
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace tamp::tasks
