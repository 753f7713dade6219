#include "runtime/graph/declaration.hpp"

namespace tamp::runtime
{

void TaskDeclaration::add(const Access& access)
{
  accesses.push_back(access);
}

}  // namespace tamp::runtime
