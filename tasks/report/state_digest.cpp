#include "tasks/report/state_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tasks/labels.hpp"

namespace tamp::tasks
{

namespace
{

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

struct ParticleHash {
  std::int64_t id;
  std::uint64_t hash;
};

/// Fields of a patch and group come sorted by the names of their labels, on every rank.
std::uint64_t hash_of(const std::vector<runtime::Field*>& fields, std::size_t particle)
{
  Fnv1a hash;
  for (const runtime::Field* field : fields) {
    const std::size_t size = field->label->value_bytes();
    if (field->state) hash.add(field->previous_buffer.data() + particle * size, size);
  }
  return hash.value();
}

std::vector<ParticleHash> own_hashes(runtime::Warehouse& warehouse)
{
  std::vector<ParticleHash> hashes;
  for (const runtime::Patch& patch : warehouse.layout()) {
    for (int g = 0; g < warehouse.n_groups(); ++g) {
      const auto ids = warehouse.state(particle::id, patch.id, g);
      const auto& fields = warehouse.particle_fields(patch.id, g);
      for (std::size_t p = 0; p < ids.size(); ++p) hashes.push_back({ids[p], hash_of(fields, p)});
    }
  }
  return hashes;
}

}  // namespace

std::string state_digest(runtime::Warehouse& warehouse, const runtime::Communicator& communicator)
{
  const std::vector<ParticleHash> own = own_hashes(warehouse);
  std::vector<ParticleHash> all;
  for (const auto& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
    const auto* first = reinterpret_cast<const ParticleHash*>(bytes.data());
    all.insert(all.end(), first, first + bytes.size() / sizeof(ParticleHash));
  }
  std::sort(all.begin(), all.end(), [](const ParticleHash& a, const ParticleHash& b) { return a.id < b.id; });
  Fnv1a hash;
  for (const ParticleHash& particle : all) {
    hash.add(reinterpret_cast<const std::byte*>(&particle.hash), sizeof particle.hash);
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace tamp::tasks
