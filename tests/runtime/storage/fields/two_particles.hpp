#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/storage/fields/field_columns.hpp"

namespace tamp::test
{

using namespace tamp::runtime;

/// Two particles of a plane scene.
struct TwoParticles {
  std::vector<std::int64_t> id{7, 9'007'199'254'740'993};  // the second is no double
  std::vector<double> mass{0.5, 0.25};
  std::vector<double> position{1, 2, 3, 4};
  std::vector<double> stress{11, 22, 33, 12, -11, -22, -33, -12};

  ParticleBlock block(const std::string& name) const
  {
    return {name,
            2,
            {{"id", ColumnKind::scalar, std::span(id)},
             {"mass", ColumnKind::scalar, std::span(mass)},
             {"position", ColumnKind::vector, std::span(position)},
             {"stress", ColumnKind::tensor, std::span(stress)}}};
  }
};

}  // namespace tamp::test
