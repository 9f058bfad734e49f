// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/MeshShape.h"

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{

MeshShape shapeOf(const TriangleMesh& mesh)
{
  MeshShape shape;
  const double count = double(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
  {
    double least = EIGEN_PI;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 u = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
      const Vec3 v = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      shape.longest = std::max(shape.longest, u.norm());
      shape.mean += u.norm() / (3.0 * count);
      least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
    shape.needles += least < 25.0 * EIGEN_PI / 180.0 ? 1.0 / count : 0.0;
  }
  return shape;
}

} // namespace hybridtree::test
