#include <array>
#include <catch2/catch.hpp>
#include <functional>

#include "runtime/file_error.hpp"
#include "runtime/storage/fields/field_file.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/file_size_limit.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_field_file_ranks
{

using namespace tamp::test;
using namespace tamp::runtime;

namespace
{

namespace fs = std::filesystem;

/// Seven patches of 0, 1, 2, 3, 0, 1 and 2 particles, and as many columns of 3 x 2 nodes, of which a rank has what
/// `is_own` says.
struct Share {
  static constexpr std::size_t n_patches = 7;

  explicit Share(const std::function<bool(std::size_t)>& is_own)
  {
    std::array<std::uint64_t, n_patches> counts{};
    for (std::size_t patch = 0; patch < n_patches; ++patch) {
      counts[patch] = patch % 4;
      if (!is_own(patch)) continue;
      for (std::size_t p = 0; p < counts[patch]; ++p) add_particle(static_cast<int>(10 * patch + p));
      const int x = 3 * static_cast<int>(patch);
      boxes.push_back({{x, 0, 0}, {x + 3, 2, 2}});
      for_each(boxes.back(), [&](const Index& i) { node_mass.push_back(i[0] + 100.0 * i[1] + 1000.0 * i[2]); });
    }
    rows = share_by_patch(counts, is_own);
  }

  void add_particle(int n)
  {
    ids.push_back(n);
    position.insert(position.end(), {1.0 * n, 2.0 * n});
  }

  std::vector<ParticleBlock> particles() const
  {
    return {{"sand",
             ids.size(),
             {{"id", ColumnKind::scalar, std::span(ids)}, {"position", ColumnKind::vector, std::span(position)}},
             rows}};
  }
  NodeBlock nodes() const
  {
    return {{0, 0, 0}, 1, {21, 2, 2}, {{"mass", ColumnKind::scalar, std::span(node_mass)}}, boxes};
  }

  std::vector<std::int64_t> ids;
  std::vector<double> position, node_mass;
  RowShare rows;
  std::vector<IndexBox> boxes;
};

Share share_of(const Communicator& communicator)
{
  const auto rank = static_cast<std::size_t>(communicator.rank()), n = static_cast<std::size_t>(communicator.size());
  return Share([=](std::size_t patch) { return patch * 5 % n == rank; });
}

}  // namespace

TEST_CASE("rows and boxes that a rank gives in any order stand in a field file where they belong")
{
  const TemporaryFolder folder;
  const std::vector<std::int64_t> ids{3, 4, 0, 1, 2};
  const std::vector<double> position(15, 0), mass{10, 11, 14, 15, 12, 13, 16, 17};
  const ParticleBlock block{
      "a",
      5,
      {{"id", ColumnKind::scalar, std::span(ids)}, {"position", ColumnKind::vector, std::span(position)}},
      RowShare{5, {{3, 2}, {0, 3}}}};
  const NodeBlock nodes{{0, 0, 0},
                        1,
                        {4, 2, 1},
                        {{"mass", ColumnKind::scalar, std::span(mass)}},
                        std::vector<IndexBox>{{{0, 0, 0}, {2, 2, 1}}, {{2, 0, 0}, {4, 2, 1}}}};

  FieldFile(folder.path()).write_step(0, 0, std::vector{block}, nodes);

  const fs::path file = folder.path() / "fields.h5";
  CHECK(read_dataset(file, "/step_00000000/particles/a/id").values == std::vector<double>{0, 1, 2, 3, 4});
  CHECK(read_dataset(file, "/step_00000000/nodes/mass").values == std::vector<double>{10, 11, 12, 13, 14, 15, 16, 17});
}

TEST_CASE("rows or boxes that do not fit are refused by a field file")
{
  const TemporaryFolder folder;
  const std::vector<double> position(6, 0), mass(4, 0);
  ParticleBlock block{"a", 2, {{"position", ColumnKind::vector, std::span(position)}}, RowShare{5, {{0, 1}}}};
  NodeBlock nodes{{0, 0, 0}, 1, {4, 2, 1}, {{"mass", ColumnKind::scalar, std::span(mass)}}};
  FieldFile file(folder.path());

  CHECK_THROWS_AS(file.write_step(0, 0, std::vector{block}), std::invalid_argument);
  block.share = RowShare{5, {{4, 2}}};
  CHECK_THROWS_AS(file.write_step(0, 0, std::vector{block}), std::invalid_argument);
  nodes.boxes = std::vector{IndexBox{{3, 0, 0}, {5, 2, 1}}};
  CHECK_THROWS_AS(file.write_step(0, 0, {}, nodes), std::invalid_argument);
  nodes.boxes = std::vector{IndexBox{{0, 0, 0}, {2, 2, 1}}};
  CHECK_NOTHROW(file.write_step(0, 0, {}, nodes));
}

TEST_CASE("ranks together write the field file that one process writes", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder together(world), alone(world);
  const Share own = share_of(world), all([](std::size_t) { return true; });
  if (world.is_first()) {
    FieldFile file(alone.path());
    for (const int step : {0, 10}) file.write_step(step, 0.1 * step, all.particles(), all.nodes());
  }

  FieldFile file(together.path(), world);
  for (const int step : {0, 10}) file.write_step(step, 0.1 * step, own.particles(), own.nodes());
  world.barrier();

  CHECK(all_datasets(together.path() / "fields.h5") == all_datasets(alone.path() / "fields.h5"));
  CHECK(read_text(together.path() / "fields.xdmf") == read_text(alone.path() / "fields.xdmf"));
  const Dataset id = read_dataset(together.path() / "fields.h5", "/step_00000010/particles/sand/id");
  CHECK(id.values == std::vector<double>{10, 20, 21, 30, 31, 32, 50, 60, 61});
  CHECK(fs::file_size(together.path() / "fields.h5") < 2 * 16384);
}

TEST_CASE("a field file is continued by all ranks", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  const Share own = share_of(world);
  {
    FieldFile file(folder.path(), world);
    for (const int step : {0, 10, 20}) file.write_step(step, 0.1 * step, own.particles(), own.nodes());
  }

  FieldFile file = FieldFile::continued(folder.path(), 10, 2, world);
  file.write_step(15, 1.5, own.particles(), own.nodes());
  world.barrier();

  CHECK(file.notice().empty());
  CHECK(all_datasets(folder.path() / "fields.h5").size() == 3 * 3 + 1);
  CHECK(count(read_text(folder.path() / "fields.xdmf"), "<Time Value=") == 6);
}

TEST_CASE("a rank without particles and a group without any are fine in a field file", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  const Share own([&](std::size_t) { return world.rank() == world.size() - 1; }),
      none([](std::size_t) { return false; });
  std::vector<ParticleBlock> blocks = own.particles();
  blocks.push_back({"void", 0, none.particles().front().columns, RowShare{}});

  FieldFile(folder.path(), world).write_step(0, 0, blocks, own.nodes());

  CHECK(read_dataset(folder.path() / "fields.h5", "/step_00000000/particles/sand/id").values.size() == 9);
  CHECK(read_dataset(folder.path() / "fields.h5", "/step_00000000/particles/void/id").values.empty());
}

TEST_CASE("what stops one rank from writing a step is an error on all, and the steps before stay readable", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  const Share own = share_of(world);
  FieldFile file(folder.path(), world);
  file.write_step(0, 0, own.particles(), own.nodes());
  std::vector<ParticleBlock> wrong = own.particles();
  if (world.is_first()) wrong.front().n += 1;

  CHECK_THROWS(file.write_step(1, 0.1, wrong, own.nodes()));
  CHECK_THROWS_AS(file.write_step(0, 0.1, own.particles(), own.nodes()), FileError);
  {
    const FileSizeLimit limit(20000);
    CHECK_THROWS_AS(file.write_step(2, 0.2, own.particles(), own.nodes()), FileError);
  }
  file.write_step(3, 0.3, own.particles(), own.nodes());
  world.barrier();

  CHECK(all_datasets(folder.path() / "fields.h5").size() == 2 * 3 + 1);
}

}  // namespace test_field_file_ranks
