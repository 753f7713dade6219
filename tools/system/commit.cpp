#include "tools/system/commit.hpp"

#include "tamp_commit.hpp"

namespace tamp::tools
{

std::string commit()
{
  return TAMP_COMMIT;
}

}  // namespace tamp::tools
