#include "runtime/graph/task_data.hpp"

#include <catch2/catch.hpp>
#include <concepts>

#include "runtime/engine.hpp"

namespace tamp::runtime::test_task_data
{

namespace
{

const ParticleLabel<double, "mass"> mass;
const ParticleLabel<double, "volume"> volume;
const NodeLabel<float, "weight"> weight;
const CellLabel<int, "count"> count;
const ReductionLabel<double, "total"> total;

/// Whether a body with such data can ask for a label.
template <class Data, class Asked>
concept Offers = requires(Data data, Asked asked)
{
  data[asked];
};

template <class Data, class Asked>
using Answer = decltype(std::declval<Data>()[std::declval<Asked>()]);

}  // namespace

TEST_CASE("a body gets what its task declared, as its type and to be written only where the task makes it", "[graph]")
{
  task("some")
      .over_patches_and_groups()
      .reads(mass.previous(), weight.halo(1).every_group())
      .computes(volume)
      .accumulates(count)
      .reduces(total)
      .body([](const TaskContext&, auto data) {
        using Data = decltype(data);
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(mass.previous())>, std::span<const double>>));
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(weight)>, PerGroup<GridView<const float>>>));
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(volume)>, std::span<double>>));
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(count)>, GridView<int>>));
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(total)>, double&>));
      });
}

TEST_CASE("a label that its task did not declare is not to be had, nor its value of another step", "[graph]")
{
  using Mass = std::remove_const_t<decltype(mass)>;
  using Data = TaskData<Argument<Mass, true, false, true>>;

  STATIC_REQUIRE(Offers<Data, Reference<Mass, true>>);
  STATIC_REQUIRE_FALSE(Offers<Data, decltype(mass)>);
  STATIC_REQUIRE_FALSE(Offers<Data, decltype(volume)>);
}

TEST_CASE("a label that is declared on a condition which does not hold is empty, and the others are in their places")
{
  const bool is_there = GENERATE(true, false);
  const PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {1, 1, 1});
  std::size_t n_masses = 99, n_volumes = 99;
  bool has_weight = !is_there;
  auto weigh = task("weigh").over_patches_and_groups().computes(weight).body([](const TaskContext&, auto) {});
  auto use = task("use")
                 .over_patches_and_groups()
                 .reads(mass.previous().when(is_there), weight.when(is_there))
                 .computes(volume)
                 .body([&](const TaskContext&, auto data) {
                   n_masses = data[mass.previous()].size();
                   has_weight = !data[weight].empty();
                   n_volumes = data[volume].size();
                 });
  Executor executor(1);
  Engine engine(layout, {"only"}, {{{std::move(weigh), std::move(use)}, {{&mass}, {&volume, &weight}}}}, executor);
  engine.warehouse().set_n_particles(0, 0, 3);

  engine.advance(1);

  CHECK(n_masses == (is_there ? 3U : 0U));
  CHECK(has_weight == is_there);
  CHECK(n_volumes == 3);
}

TEST_CASE("a label of the start or of the end of the step is asked for by itself")
{
  const StepEnd end = GENERATE(StepEnd::start, StepEnd::end);
  const PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {1, 1, 1});
  double seen = 0;
  auto grow = task("grow")
                  .over_patches_and_groups()
                  .reads(mass.previous())
                  .computes(mass)
                  .body([](const TaskContext&, auto data) { data[mass][0] = data[mass.previous()][0] + 1; });
  auto look = task("look")
                  .over_patches_and_groups()
                  .reads(mass.at(end))
                  .computes(volume)
                  .body([&](const TaskContext&, auto data) { seen = data[mass][0]; });
  Executor executor(1);
  Engine engine(layout, {"only"}, {{{std::move(grow), std::move(look)}, {{&mass}, {&volume}}}}, executor);
  engine.warehouse().set_n_particles(0, 0, 1);
  engine.warehouse().state(mass, 0, 0)[0] = 5;

  engine.advance(1);

  CHECK(seen == (end == StepEnd::start ? 5 : 6));
}

}  // namespace tamp::runtime::test_task_data
