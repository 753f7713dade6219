#include "runtime/graph/task_data.hpp"

#include <catch2/catch.hpp>
#include <concepts>

#include "runtime/graph/declaration.hpp"

namespace tamp::runtime::test_task_data
{

namespace
{

struct Sum {
  double value = 0;
  void combine(const Sum& other) { value += other.value; }
};

const ParticleLabel<double, "mass"> mass;
const ParticleLabel<double, "volume"> volume;
const NodeLabel<float, "weight"> weight;
const CellLabel<int, "count"> count;
const ReductionLabel<Sum, "total"> total;

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
        STATIC_REQUIRE((std::same_as<Answer<Data, decltype(total)>, Sum&>));
        STATIC_REQUIRE((data.has(mass) && data.has(volume)));
      });
}

TEST_CASE("a label that its task did not declare is not to be had, nor its value of another step", "[graph]")
{
  using Mass = std::remove_const_t<decltype(mass)>;
  using Data = TaskData<Argument<Mass, true, false, true>>;

  STATIC_REQUIRE(Offers<Data, Reference<Mass, true>>);
  STATIC_REQUIRE(Data::has(mass));
  STATIC_REQUIRE_FALSE(Offers<Data, decltype(mass)>);
  STATIC_REQUIRE_FALSE(Offers<Data, decltype(volume)>);
  STATIC_REQUIRE_FALSE(Data::has(volume));
}

}  // namespace tamp::runtime::test_task_data
