// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

Box3 TriangleMesh::bounds() const
{
  Box3 box;
  for (const Vec3& point : points)
  {
    box.extend(point);
  }
  return box;
}

Vec3 areaNormal(const TriangleMesh& mesh, std::size_t t)
{
  const Triangle& c = mesh.triangles[t];
  const Vec3& a = mesh.points[c[0]];
  return (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a);
}

double signedVolume(const TriangleMesh& mesh)
{
  if (mesh.points.empty())
  {
    return 0.0;
  }
  // From a point near the mesh, so that a far-away model loses no digits.
  const Vec3 origin = mesh.points.front();
  double sixfold = 0.0;
  for (const Triangle& c : mesh.triangles)
  {
    sixfold += (mesh.points[c[0]] - origin)
                 .dot((mesh.points[c[1]] - origin).cross(mesh.points[c[2]] - origin));
  }
  return sixfold / 6.0;
}

} // namespace hybridtree
