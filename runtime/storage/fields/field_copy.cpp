#include "runtime/storage/fields/field_copy.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "runtime/graph/graph_error.hpp"
#include "runtime/ranks/gather_by_patch.hpp"

namespace tamp::runtime
{

namespace
{

using Counts = std::vector<std::uint64_t>;

/// Brings the values of columns to the first rank one by one, so that no more than one of them is there twice.
class ValueGatherer
{
 public:
  ValueGatherer(std::deque<FieldCopy::Values>& values, const PatchLayout& layout, const Communicator& communicator)
      : next_(values.begin()), layout_(layout), communicator_(communicator)
  {
  }

  /// Gathers the values of the next `n_columns` columns, which have `n_own` items here and `n_items` on each patch.
  void gather(std::size_t n_columns, std::size_t n_own, const Counts& n_items)
  {
    for (std::size_t i = 0; i < n_columns; ++i) {
      std::visit([&](auto& own) { own = of_all(std::move(own), n_own, n_items); }, *next_++);
    }
  }

 private:
  template <class T>
  std::vector<T> of_all(std::vector<T> own, std::size_t n_own, Counts n_values) const
  {
    // A rank without items cannot tell how many components they have.
    const std::uint64_t n_components = communicator_.max(n_own == 0 ? 0 : std::uint64_t{own.size() / n_own});
    for (std::uint64_t& n : n_values) n *= n_components;
    return gather_by_patch(std::move(own), n_values, layout_, communicator_);
  }

  std::deque<FieldCopy::Values>::iterator next_;
  const PatchLayout& layout_;
  const Communicator& communicator_;
};

Counts sizes_of(const std::vector<IndexBox>& boxes)
{
  Counts sizes;
  for (const IndexBox& box : boxes) sizes.push_back(static_cast<std::uint64_t>(box.size()));
  return sizes;
}

std::size_t sum(const Counts& counts)
{
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

std::size_t n_items_of(const NodeBlock& nodes)
{
  const auto& [nx, ny, nz] = nodes.n_nodes;
  return nodes.boxes ? sum(sizes_of(*nodes.boxes))
                     : static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
}

}  // namespace

std::size_t FieldCopy::n_bytes() const
{
  std::size_t of_values = 0, most_numbers = 0;
  for (const Values& column : values) {
    of_values += std::visit([](const auto& own) { return own.capacity() * sizeof(own.front()); }, column);
  }
  const auto look = [&](const std::vector<Column>& columns, std::size_t n_items) {
    for (const Column& column : columns) most_numbers = std::max(most_numbers, n_items * n_in_file(column.kind));
  };
  for (const ParticleBlock& block : particles) look(block.columns, block.n);
  if (nodes) look(nodes->columns, n_items_of(*nodes));
  return of_values + most_numbers * sizeof(double);
}

void FieldCopy::show_values()
{
  auto next = values.begin();
  const auto show = [&](std::vector<Column>& columns) {
    for (Column& column : columns) {
      std::visit([&](const auto& own) { column.values = std::span(own); }, *next++);
    }
  };
  for (ParticleBlock& block : particles) show(block.columns);
  if (nodes) show(nodes->columns);
}

FieldCopy gathered(FieldCopy own, const PatchLayout& layout, const Communicator& communicator)
{
  expect_ranks(layout, communicator.size());
  if (communicator.size() == 1) return own;
  ValueGatherer values(own.values, layout, communicator);
  for (std::size_t b = 0; b < own.particles.size(); ++b) {
    ParticleBlock& block = own.particles[b];
    values.gather(block.columns.size(), block.n, own.n_particles[b]);
    block.n = sum(own.n_particles[b]);
    block.share.reset();
  }
  if (own.nodes) {
    std::vector<IndexBox> of_all;
    for (const Patch& patch : layout) of_all.push_back(layout.shown_nodes(patch));
    values.gather(own.nodes->columns.size(), sum(sizes_of(own.nodes->boxes.value())), sizes_of(of_all));
    own.nodes->boxes = std::move(of_all);
  }
  if (!communicator.is_first()) return {};
  own.show_values();
  own.held.hold(own.n_bytes());
  return own;
}

}  // namespace tamp::runtime
