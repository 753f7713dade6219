// Stands in for closed_mesh.cpp in a build without meshes.
#include "components/errors.hpp"
#include "components/geometry/closed_mesh.hpp"

namespace tamp::components
{

const bool ClosedMesh::is_available = false;

struct ClosedMesh::Surface {
};

ClosedMesh::ClosedMesh(std::istream&, double)
{
  throw BadValue("a mesh, which this build cannot read", "a build with -DTAMP_MESHES=ON");
}

bool ClosedMesh::contains(const Vector<3>&) const
{
  return false;
}

double ClosedMesh::reach(const Vector<3>&) const
{
  return 0;
}

void ClosedMesh::faces(const Vector<3>&, SurfacePoints<3>&) const {}

Volume ClosedMesh::volume() const
{
  return {0};
}

}  // namespace tamp::components
