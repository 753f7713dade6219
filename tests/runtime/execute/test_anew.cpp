#include <catch2/catch.hpp>
#include <memory>

#include "runtime/engine.hpp"

namespace tamp::runtime::test_anew
{

namespace
{

const NodeLabel<double, "share"> share;
const NodeLabel<double, "first sum"> first_sum;
const NodeLabel<double, "second sum"> second_sum;

/// Every patch gives to each node that it reaches, the more the later the pass.
TaskDeclaration give(const std::string& name, const Reference<std::remove_const_t<decltype(share)>>& to, double amount)
{
  return task(name).over_patches_and_groups().accumulates(to.halo(1)).body([amount](const TaskContext& at, auto data) {
    const auto part = data[share];
    for_each(part.box(), [&](const Index& i) {
      part[i] += amount * (1 + at.patch.id + static_cast<double>(at.step.index) + 0.1 * i[1]);
    });
  });
}

template <class Result>
TaskDeclaration keep(const std::string& name, const Result& result)
{
  return task(name).over_patches_and_groups().reads(share).computes(result).body([&](const TaskContext& at, auto data) {
    const auto sum = data[share];
    const auto kept = data[result];
    for_each(at.patch.nodes, [&](const Index& i) { kept[i] = sum[i]; });
  });
}

PatchLayout layout_on(int n_ranks)
{
  PatchLayout layout({2, {0, 0, 0}, 1, {12, 12, 1}}, {4, 4, 1});
  std::vector<int> ranks = layout.ranks();
  for (std::size_t p = 0; p < ranks.size(); ++p) ranks[p] = static_cast<int>(p) % n_ranks;
  layout.give_to_ranks(ranks, n_ranks);
  return layout;
}

}  // namespace

TEST_CASE("a label that begins anew is summed from zero, and what was read before it was the sum before", "[ranks]")
{
  const Communicator all = Communicator::world();
  const int n_threads = GENERATE(0, 1, 2);
  const auto executor = n_threads == 0 ? Executor::shuffled(3) : std::make_unique<Executor>(n_threads);
  const PatchLayout layout = layout_on(all.size());
  std::vector<TaskDeclaration> tasks{give("give once", share.reference(), 1), give("give again", share.reference(), 2),
                                     keep("keep first", first_sum), give("give anew", share.anew(), 10),
                                     keep("keep second", second_sum)};
  Engine engine(layout, {"only"}, {{std::move(tasks), {{}, {&first_sum, &second_sum}}}}, *executor, all);

  bool as_expected = true;
  for (long step = 0; step < 20; ++step) {
    engine.advance(1);
    for (const Patch& patch : layout) {
      if (patch.rank != all.rank()) continue;
      const auto first = engine.warehouse().grid_result(first_sum, patch.id, 0);
      const auto second = engine.warehouse().grid_result(second_sum, patch.id, 0);
      for_each(patch.nodes, [&](const Index& i) {
        double expected = 0;
        for (const Patch& other : layout) {
          if (grown(other.nodes, 1, 2).contains(i)) expected += 1 + other.id + static_cast<double>(step) + 0.1 * i[1];
        }
        as_expected &= std::abs(first[i] - 3 * expected) < 1e-9 * expected;
        as_expected &= std::abs(second[i] - 10 * expected) < 1e-9 * expected;
      });
    }
  }

  CHECK(as_expected);
}

TEST_CASE("only what is accumulated begins anew, and each sum has to be read")
{
  const PatchLayout layout = layout_on(1);
  const auto message_of = [&](std::vector<TaskDeclaration> tasks) -> std::string {
    try {
      const TaskGraph graph(std::move(tasks), layout, {"only"}, {{}, {&first_sum}});
      return "";
    } catch (const GraphError& error) {
      return error.what();
    }
  };

  CHECK(message_of({give("give", share.anew(), 1), keep("keep", first_sum)}).empty());
  CHECK_THAT(message_of({give("give", share.reference(), 1), keep("keep", first_sum), give("waste", share.anew(), 1)}),
             Catch::Contains("waste") && Catch::Contains("never read"));
  CHECK_THAT(
      message_of(
          {task("compute").over_patches_and_groups().computes(first_sum.anew()).body([](const TaskContext&, auto) {})}),
      Catch::Contains("only what is accumulated can begin anew"));
}

}  // namespace tamp::runtime::test_anew
