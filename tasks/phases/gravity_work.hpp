#pragma once

#include "tasks/method.hpp"
#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// Counts what gravity and a steady centrifuge do to a particle of this mass on its way in a step of size `dt`. The way
/// must not be cut by a periodic end.
template <int D>
void add_gravity_work(const Method<D>& method, double dt, double mass, const Vector<D>& before, const Vector<D>& after,
                      const Vector<D>& velocity, GridTotals& totals)
{
  const double work = method.work_function(after);
  totals.gravity_work += mass * (work - method.work_function(before));
  totals.gravity_work_at_end += mass * (work - method.work_function(after - 0.5 * dt * velocity));
}

}  // namespace tamp::tasks
