// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{

/// Share of triangles with an angle below `degrees`, 0 to 1.
inline double shareBelow(const TriangleMesh& mesh, double degrees)
{
  std::size_t below = 0;
  for (const Triangle& c : mesh.triangles)
  {
    double smallest = 180.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 u = mesh.points[c[(k + 1) % 3]] - mesh.points[c[k]];
      const Vec3 v = mesh.points[c[(k + 2) % 3]] - mesh.points[c[k]];
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 57.29577951308232);
    }
    below += smallest < degrees;
  }
  return static_cast<double>(below) / static_cast<double>(mesh.triangles.size());
}

} // namespace hybridtree::test
