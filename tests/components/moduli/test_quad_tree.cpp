#include "components/moduli/quad_tree.hpp"

#include <catch2/catch.hpp>

namespace test_quad_tree
{

using tamp::components::QuadTree;

namespace
{

constexpr QuadTree::Place unit = QuadTree::Place{1} << QuadTree::fraction_bits;

}  // namespace

TEST_CASE("a quad tree that was never cut has its squares as leaves, row by row")
{
  const QuadTree tree(3, 2);

  CHECK(tree.find(0, 0).number == 0);
  CHECK(tree.find(3 * unit - 1, 0).number == 2);
  CHECK(tree.find(unit, unit).number == 4);
  CHECK(tree.find(unit, unit).side_bits == QuadTree::fraction_bits);
}

TEST_CASE("a cut square's lower left quarter keeps its number, and the others are numbered on")
{
  QuadTree tree(3, 2);

  tree.cut(unit, 0);

  CHECK(tree.find(unit, 0).number == 1);
  CHECK(tree.find(unit + unit / 2, 0).number == 6);
  CHECK(tree.find(unit, unit / 2).number == 7);
  CHECK(tree.find(2 * unit - 1, unit - 1).number == 8);
  CHECK(tree.find(2 * unit - 1, unit - 1).side_bits == QuadTree::fraction_bits - 1);
  CHECK(tree.find(2 * unit, 0).number == 2);
}

TEST_CASE("quarters of quarters are found down to the smallest")
{
  QuadTree tree(1, 1);

  for (int i = 0; i < QuadTree::most_cuts; ++i) tree.cut(unit / 3, unit / 3);

  const QuadTree::Leaf leaf = tree.find(unit / 3, unit / 3);
  CHECK(leaf.side_bits == QuadTree::fraction_bits - QuadTree::most_cuts);
  CHECK(tree.find(unit / 3 ^ (QuadTree::Place{1} << leaf.side_bits), unit / 3).number != leaf.number);
}

TEST_CASE("a quad tree contains its squares up to but not including the far edges")
{
  const QuadTree tree(3, 2);

  CHECK(tree.contains(0, 0));
  CHECK(tree.contains(3 * unit - 1, 2 * unit - 1));
  CHECK_FALSE(tree.contains(3 * unit, 0));
  CHECK_FALSE(tree.contains(0, 2 * unit));
  CHECK_FALSE(tree.contains(-1, 0));
}

}  // namespace test_quad_tree
