#include "runtime/execute/migration.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tamp::runtime
{

namespace
{

std::vector<Field*> state_fields(const Warehouse& warehouse, int patch, int group)
{
  std::vector<Field*> fields = warehouse.particle_fields(patch, group);
  std::erase_if(fields, [](const Field* f) { return !f->state; });
  return fields;
}

std::byte* value(Field& field, std::size_t particle)
{
  return field.buffer(FieldBuffer::current).data() + particle * field.label->value_bytes();
}

/// Moves the values of particles from `first` to `end` down to `to`.
void move_down(const std::vector<Field*>& fields, std::size_t to, std::size_t first, std::size_t end)
{
  if (to == first) return;
  for (Field* f : fields) std::memmove(value(*f, to), value(*f, first), (end - first) * f->label->value_bytes());
}

std::size_t bytes_of_particle(const std::vector<Field*>& fields)
{
  std::size_t n = 0;
  for (const Field* f : fields) n += f->label->value_bytes();
  return n;
}

const Label* laps_label(const TaskDeclaration& migration)
{
  const auto& accesses = migration.accesses;
  return accesses.size() > 1 && accesses[1].mode == Mode::update ? accesses[1].label : nullptr;
}

/// Number of the cell in which a coordinate is, as far outside of the grid as it may be.
double cell_along(const Grid& grid, std::size_t axis, double x)
{
  return std::floor(grid.cells_from_lower(axis, x));
}

}  // namespace

void ParticleParcel::add(const std::byte* bytes, std::size_t n)
{
  // To twice the size at once, as a parcel grows by a particle at a time.
  if (n_bytes + n > buffer.capacity()) buffer.reserve(2 * (n_bytes + n));
  std::memcpy(buffer.data() + n_bytes, bytes, n);
  n_bytes += n;
}

Migration::Migration(Warehouse& warehouse, const TaskDeclaration& declaration)
    : warehouse_(warehouse),
      position_(*declaration.accesses.front().label),
      laps_(laps_label(declaration)),
      outboxes_(static_cast<std::size_t>(warehouse.layout().size() * warehouse.n_groups())),
      arrivals_(outboxes_.size()),
      fields_(outboxes_.size())
{
  LedgerEntry& entry = warehouse.ledger().entry("particles that change patches");
  for (const Patch& patch : warehouse.layout()) {
    for (int g = 0; g < warehouse.n_groups(); ++g) {
      fields_[place(patch.id, g)] = state_fields(warehouse, patch.id, g);
      auto& parcels = arrivals_[place(patch.id, g)];
      parcels.resize(patch.neighbours.size());
      for (std::size_t k = 0; k < parcels.size(); ++k) {
        parcels[k].buffer = Buffer(entry);
        box(patch.neighbours[k], g).to_patch[patch.id] = &parcels[k];
      }
    }
  }
}

/// Whether a place is in these cells of the grid: what holds for almost all particles, found out fast.
bool Migration::stays(const IndexBox& cells, const std::byte* position) const
{
  const Grid& grid = warehouse_.layout().grid();
  for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
    double x = 0;
    std::memcpy(&x, position + k * sizeof(double), sizeof(double));
    const double place = grid.cells_from_lower(k, x);
    if (!(place >= cells.lower[k] && place < cells.upper[k])) return false;
  }
  return true;
}

/// The patch that owns a place, put back into a periodic grid; -1 outside.
int Migration::destination(std::byte* position, Index& laps) const
{
  const Grid& grid = warehouse_.layout().grid();
  Index cell{0, 0, 0};
  for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
    double x = 0;
    std::memcpy(&x, position + k * sizeof(double), sizeof(double));
    double place = cell_along(grid, k, x);
    // The comparison is false for what is not a number, too.
    const auto is_inside = [&]() { return place >= 0 && place < grid.n_cells[k]; };
    if (grid.periodic[k] && !is_inside()) place = put_back(k, position + k * sizeof(double), laps);
    if (!is_inside()) return -1;
    cell[k] = static_cast<int>(place);
  }
  return warehouse_.layout().patch_of_cell(cell);
}

/// Moves a coordinate beyond one end of a periodic axis as far beyond the other, counts that, and gives its cell. Only
/// here do coordinates change, by the same numbers however the grid is cut.
double Migration::put_back(std::size_t axis, std::byte* coordinate, Index& laps) const
{
  const Grid& grid = warehouse_.layout().grid();
  double x = 0;
  std::memcpy(&x, coordinate, sizeof(double));
  int lap = x < grid.lower[axis] ? -1 : 1;
  x -= lap * grid.length(axis);
  double place = cell_along(grid, axis, x);
  // A particle that is outside by round-off alone is on both ends: the lower one is in a cell.
  if (lap > 0 ? place < 0 : place == grid.n_cells[axis]) {
    x = grid.lower[axis];
    place = 0;
    lap = std::max(lap, 0);
  }
  std::memcpy(coordinate, &x, sizeof(double));
  laps[axis] += lap;
  return place;
}

void Migration::pack(ParticleParcel& parcel, std::size_t particle, const std::vector<Field*>& fields) const
{
  for (Field* f : fields) parcel.add(value(*f, particle), f->label->value_bytes());
  ++parcel.n_particles;
}

void Migration::hold(int patch, int group)
{
  Outbox& out = box(patch, group);
  if (!std::exchange(out.used, false)) return;
  for (auto& [destination_patch, parcel] : out.to_patch) parcel->clear();
}

void Migration::send(int patch, int group)
{
  hold(patch, group);
  Outbox& out = box(patch, group);
  const std::size_t n = warehouse_.n_particles(patch, group);
  if (n == 0) return;
  Field& positions = warehouse_.field(position_, patch, group);
  Index uncounted{0, 0, 0};
  Index* const laps =
      laps_ == nullptr ? nullptr : reinterpret_cast<Index*>(value(warehouse_.field(*laps_, patch, group), 0));
  const std::vector<Field*>& fields = fields_[place(patch, group)];
  const IndexBox& cells = warehouse_.layout()[patch].cells;
  // `n_kept` of the particles before `first` stay; `first` is the one behind the last that left.
  std::size_t n_kept = 0, first = 0;
  for (std::size_t p = 0; p < n; ++p) {
    if (stays(cells, value(positions, p))) continue;
    const int to = destination(value(positions, p), laps == nullptr ? uncounted : laps[p]);
    if (to == patch) continue;
    if (to >= 0) {
      const auto parcel = out.to_patch.find(to);
      if (parcel == out.to_patch.end()) throw std::runtime_error("a particle moved past a whole patch in one step");
      pack(*parcel->second, p, fields);
      out.used = true;
    }
    move_down(fields, n_kept, first, p);
    n_kept += p - first;
    first = p + 1;
  }
  if (first == 0) return;
  move_down(fields, n_kept, first, n);
  warehouse_.set_n_particles(patch, group, n_kept + n - first);
}

void Migration::receive(int patch, int group)
{
  const auto& parcels = arrivals_[place(patch, group)];
  std::size_t n_arrivals = 0;
  for (const ParticleParcel& parcel : parcels) n_arrivals += parcel.n_particles;
  if (n_arrivals == 0) return;
  std::size_t n = warehouse_.n_particles(patch, group);
  warehouse_.set_n_particles(patch, group, n + n_arrivals);
  const std::vector<Field*>& fields = fields_[place(patch, group)];
  for (const ParticleParcel& parcel : parcels) {
    const std::byte* from = parcel.buffer.data();
    for (std::size_t end = n + parcel.n_particles; n < end; ++n) {
      for (Field* f : fields) {
        std::memcpy(value(*f, n), from, f->label->value_bytes());
        from += f->label->value_bytes();
      }
    }
  }
}

void Migration::write_parcel(const MessagePart& part, std::vector<std::byte>& message) const
{
  const ParticleParcel& parcel = *box(part.from_patch, part.group).to_patch.at(part.to_patch);
  const auto* n = reinterpret_cast<const std::byte*>(&parcel.n_particles);
  message.insert(message.end(), n, n + sizeof parcel.n_particles);
  message.insert(message.end(), parcel.buffer.data(), parcel.buffer.data() + parcel.n_bytes);
}

const std::byte* Migration::read_parcel(const MessagePart& part, const std::byte* from)
{
  ParticleParcel& parcel = *box(part.from_patch, part.group).to_patch.at(part.to_patch);
  parcel.clear();
  std::memcpy(&parcel.n_particles, from, sizeof parcel.n_particles);
  from += sizeof parcel.n_particles;
  if (parcel.n_particles == 0) return from;
  const std::size_t n_bytes = parcel.n_particles * bytes_of_particle(fields_[place(part.to_patch, part.group)]);
  parcel.add(from, n_bytes);
  return from + n_bytes;
}

}  // namespace tamp::runtime
