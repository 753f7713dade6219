#include "components/contact/contact_table.hpp"

#include <algorithm>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{
namespace
{

double checked(double friction)
{
  if (!(friction >= 0)) throw BadValue("coefficient of friction " + std::to_string(friction), "0 or above");
  return friction;
}

std::size_t n_pairs(int n_groups)
{
  if (n_groups < 1) throw BadValue(std::to_string(n_groups) + " contact groups", "1 or more");
  return static_cast<std::size_t>(n_groups) * static_cast<std::size_t>(n_groups);
}

}  // namespace

ContactTable::ContactTable(int n_groups, double friction)
    : n_groups_(n_groups), pairs_(n_pairs(n_groups), Pair{checked(friction), FlatterNormal()})
{
}

void ContactTable::set(int a, int b, double friction, const ContactNormal& normal)
{
  if (a < 0 || b < 0 || a >= n_groups_ || b >= n_groups_ || a == b) {
    throw BadValue("contact groups " + std::to_string(a) + " and " + std::to_string(b),
                   "two different groups from 0 to " + std::to_string(n_groups_ - 1));
  }
  if (const auto* own = std::get_if<OwnNormal>(&normal); own != nullptr && own->owner != a && own->owner != b) {
    throw BadValue("the normal of group " + std::to_string(own->owner), "that of one of the two");
  }
  pairs_[place(a, b)] = pairs_[place(b, a)] = {checked(friction), normal};
}

bool ContactTable::finds_faces() const
{
  return std::any_of(pairs_.begin(), pairs_.end(),
                     [](const Pair& pair) { return components::finds_faces(pair.normal); });
}

bool ContactTable::needs_surface_of(int group) const
{
  for (int other = 0; other < n_groups_; ++other) {
    const auto asks = [&](const auto& kind) { return kind.needs_surface_of(group); };
    if (other != group && std::visit(asks, normal(group, other))) return true;
  }
  return false;
}

}  // namespace tamp::components
