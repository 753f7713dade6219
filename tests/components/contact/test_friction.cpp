#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "components/contact/friction.hpp"

namespace test_friction
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// Masses and velocities of several materials at one node.
template <int D>
struct Node {
  std::vector<double> mass;
  std::vector<Vector<D>> velocity;
  std::vector<Vector<D>> surface_gradient;
  std::vector<ContactFace<D>> face{};

  double resolve(const ContactTable& friction, const ContactThresholds& thresholds = {})
  {
    return resolve_contact<D>(mass, {surface_gradient, face}, friction, thresholds, velocity);
  }

  Vector<D> momentum() const
  {
    Vector<D> sum = Vector<D>::Zero();
    for (std::size_t a = 0; a < mass.size(); ++a) sum += mass[a] * velocity[a];
    return sum;
  }

  double kinetic_energy() const
  {
    double sum = 0;
    for (std::size_t a = 0; a < mass.size(); ++a) sum += 0.5 * mass[a] * velocity[a].squaredNorm();
    return sum;
  }
};

/// A body of 2 kg above one of 3 kg: it comes down at `down` and slides to the right at `slide`.
Node<2> body_on_body(double slide, double down)
{
  return {{2, 3}, {Vector<2>(slide, -down), Vector<2>(0, 0)}, {Vector<2>(0, -1), Vector<2>(0, 1)}};
}

template <int D>
Node<D> random_node(std::mt19937& random, std::size_t n_groups)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector<D>(Vector<D>::NullaryExpr([&] { return uniform(random); })); };
  Node<D> node;
  for (std::size_t a = 0; a < n_groups; ++a) {
    node.mass.push_back(std::pow(10, 2 * uniform(random)));
    node.velocity.push_back(10 * vector());
    node.surface_gradient.push_back(vector());
  }
  return node;
}

}  // namespace

TEST_CASE("of two surfaces the one with the longer gradient gives the normal, and alike ones share it")
{
  const Vector<2> flat(0, 1), edge(0.5, -0.6), like(0.1, -1);

  CHECK(facing<2>(flat, edge) == flat);
  CHECK(facing<2>(edge, flat) == -flat);
  CHECK(facing<2>(flat, -flat) == 2 * flat);
  // Joining in as lengths come together is gradual, and the same from both sides.
  CHECK((facing<2>(flat, like) + facing<2>(like, flat)).norm() < 1e-15);
  CHECK(facing<2>(flat, Vector<2>(0.05, -0.95)).x() == Approx(-0.05 * (std::hypot(0.05, 0.95) - 0.9) / 0.1));
}

TEST_CASE("bodies that meet without friction lose their approach and keep their sliding")
{
  Node<2> node = body_on_body(4, 10);

  const double energy = node.kinetic_energy(), approach_speed = node.resolve(ContactTable(2, 0));

  // Momentum down is 2 * 10; together 5 kg go down at 4 m/s.
  CHECK(node.velocity[0].isApprox(Vector<2>(4, -4), 1e-15));
  CHECK(node.velocity[1].isApprox(Vector<2>(0, -4), 1e-15));
  CHECK(approach_speed == Approx(10));
  // Half the reduced mass times the square of the approach.
  CHECK(energy - node.kinetic_energy() == Approx(0.5 * 1.2 * 100));
}

TEST_CASE("sliding above the Coulomb limit loses friction times the normal impulse")
{
  Node<2> node = body_on_body(4, 10);

  const double energy = node.kinetic_energy();
  node.resolve(ContactTable(2, 0.25));

  // Reduced mass 1.2 kg: normal impulse 12 N s, tangential 3 N s.
  CHECK(node.velocity[0].isApprox(Vector<2>(4 - 3 / 2.0, -10 + 12 / 2.0), 1e-14));
  CHECK(node.velocity[1].isApprox(Vector<2>(3 / 3.0, -12 / 3.0), 1e-14));
  // Friction works over the mean sliding speed, (4 + 1.5) / 2.
  CHECK(energy - node.kinetic_energy() == Approx(60 + 3 * 2.75));
}

TEST_CASE("below the Coulomb limit the bodies stick")
{
  Node<2> node = body_on_body(4, 10);

  node.resolve(ContactTable(2, 0.5));

  CHECK((node.velocity[0] - node.velocity[1]).norm() < 1e-14);
  CHECK(node.velocity[0].isApprox(Vector<2>(1.6, -4), 1e-14));
}

TEST_CASE("without slip bodies that approach ever so slowly do not slide")
{
  Node<2> node = body_on_body(1000, 1e-6);

  node.resolve(ContactTable(2, ContactTable::no_slip));

  CHECK((node.velocity[0] - node.velocity[1]).norm() < 1e-12);
}

TEST_CASE("bodies that part or rest on each other feel nothing, not even friction")
{
  const double friction = GENERATE(0.0, 0.5, ContactTable::no_slip);
  for (const double down : {-1e-9, -10.0, 0.0}) {
    Node<2> node = body_on_body(4, down);
    const auto before = node.velocity;

    const double approach_speed = node.resolve(ContactTable(2, friction));

    CHECK(node.velocity == before);
    CHECK(approach_speed == 0);
  }
}

TEST_CASE("a body of infinite mass stops the other and keeps its velocity")
{
  Vector<3> moving(1, 2, -8), wall(0, 0, 1);
  const Vector<3> towards_wall(0, 0, -1);

  const auto impulse = collide<3>(2, std::numeric_limits<double>::infinity(), towards_wall, 0, moving, wall);

  CHECK(moving.isApprox(Vector<3>(1, 2, 1), 1e-15));
  CHECK(wall == Vector<3>(0, 0, 1));
  CHECK(impulse.on_second.isApprox(Vector<3>(0, 0, -18), 1e-15));
}

TEST_CASE("contact keeps momentum to round-off and never adds energy")
{
  std::mt19937 random(3);
  for (const std::size_t n_groups : {2u, 3u, 5u}) {
    const int n = static_cast<int>(n_groups);
    ContactTable friction(n, 0.3);
    friction.set(0, 1, ContactTable::no_slip);
    if (n > 2) friction.set(1, 2, 0);
    int n_met = 0;
    for (int sample = 0; sample < 300; ++sample) {
      Node<3> node = random_node<3>(random, n_groups);
      const Vector<3> momentum = node.momentum();
      const double energy = node.kinetic_energy();

      const double approach_speed = node.resolve(friction);

      n_met += approach_speed > 0;
      REQUIRE((node.momentum() - momentum).norm() < 1e-14 * (1 + 20 * 100 * static_cast<double>(n)));
      REQUIRE(node.kinetic_energy() <= (1 + 1e-12) * energy);
    }
    CHECK(n_met > 100);
  }
}

TEST_CASE("swapping two materials swaps what happens to them")
{
  std::mt19937 random(5);
  for (int sample = 0; sample < 100; ++sample) {
    Node<2> node = random_node<2>(random, 2), swapped = node;
    std::swap(swapped.mass[0], swapped.mass[1]);
    std::swap(swapped.velocity[0], swapped.velocity[1]);
    std::swap(swapped.surface_gradient[0], swapped.surface_gradient[1]);

    node.resolve(ContactTable(2, 0.3));
    swapped.resolve(ContactTable(2, 0.3));

    CHECK((node.velocity[0] - swapped.velocity[1]).norm() < 1e-13);
    CHECK((node.velocity[1] - swapped.velocity[0]).norm() < 1e-13);
  }
}

TEST_CASE("of three materials each pair has its own friction and an absent one takes no part")
{
  ContactTable friction(3, 0);
  friction.set(0, 2, ContactTable::no_slip);
  Node<2> node = body_on_body(4, 10);
  // The lower body becomes the third material; the second has no mass here, and values that must not be used.
  node.mass = {2, 0, 3};
  node.velocity.insert(node.velocity.begin() + 1, Vector<2>::Constant(std::nan("")));
  node.surface_gradient.insert(node.surface_gradient.begin() + 1, Vector<2>::Constant(std::nan("")));

  node.resolve(friction);

  CHECK(node.velocity[0].isApprox(Vector<2>(1.6, -4), 1e-14));
  CHECK(node.velocity[2].isApprox(Vector<2>(1.6, -4), 1e-14));
}

TEST_CASE("pairs are resolved in the order of the materials, each after the pair before it")
{
  // On a line: 0 runs at 6 m/s into 1, which then runs into 2; pair (0, 2) meets before (1, 2) does.
  Node<2> node{{1, 1, 1},
               {Vector<2>(6, 0), Vector<2>(0, 0), Vector<2>(0, 0)},
               {Vector<2>(1, 0), Vector<2>(0, 0), Vector<2>(-1, 0)}};

  const double approach_speed = node.resolve(ContactTable(3, 0));

  // (0, 1): 3, 3, 0. (0, 2): 1.5, 3, 1.5. (1, 2): 1.5, 2.25, 2.25.
  CHECK(node.velocity[0].isApprox(Vector<2>(1.5, 0), 1e-15));
  CHECK(node.velocity[1].isApprox(Vector<2>(2.25, 0), 1e-15));
  CHECK(node.velocity[2].isApprox(Vector<2>(2.25, 0), 1e-15));
  CHECK(approach_speed == Approx(6));
}

TEST_CASE("without a normal, or with a mass at the threshold, nothing happens")
{
  Node<2> no_normal = body_on_body(4, 10), light = body_on_body(4, 10);
  no_normal.surface_gradient[0] = no_normal.surface_gradient[1] + Vector<2>(0, -1e-12);
  const auto before = light.velocity;

  no_normal.resolve(ContactTable(2, 0.3), {0, 1e-9});
  light.resolve(ContactTable(2, 0.3), {2, 1e-9});
  Node<2> other_light = body_on_body(4, 10);
  other_light.mass = {3, 2};
  other_light.resolve(ContactTable(2, 0.3), {2, 1e-9});

  CHECK(no_normal.velocity == before);
  CHECK(light.velocity == before);
  CHECK(other_light.velocity == before);

  no_normal.surface_gradient[0] = no_normal.surface_gradient[1];
  no_normal.resolve(ContactTable(2, 0.3));

  CHECK(no_normal.velocity == before);
}

TEST_CASE("a pair's normal may be that of either surface alone")
{
  const std::vector<Vector<2>> gradient{{1, 0}, {-0.5, -1}};
  ContactTable table(2);
  table.set(0, 1, 0.3, OwnNormal{0});
  CHECK(normal_at<2>(table, 0, 1, {gradient}, 0) == gradient[0]);
  table.set(0, 1, 0.3, OwnNormal{1});
  CHECK(normal_at<2>(table, 0, 1, {gradient}, 0)->isApprox(-gradient[1].normalized(), 1e-15));
  CHECK(normal_at<2>(table, 1, 0, {gradient}, 0)->isApprox(gradient[1].normalized(), 1e-15));
}

TEST_CASE("materials meet along the face that their contact has found, where it leaves no gap")
{
  Node<2> node = body_on_body(4, 10);
  node.face = {{Vector<2>(3, 0), 0.001}, {Vector<2>(-3, 0), 0.001}};
  const auto before = node.velocity;

  node.resolve(ContactTable(2));

  CHECK(node.velocity == before);
  node.face[0].gap = node.face[1].gap = 0;

  node.resolve(ContactTable(2));

  CHECK(node.velocity[0].x() == Approx(node.velocity[1].x()));
  CHECK(node.velocity[0].y() == before[0].y());
}

}  // namespace test_friction
