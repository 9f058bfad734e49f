// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

/// By which a mesher sees whether it has kept to the length asked for; 0 of an empty mesh.
inline double longestEdge(const TriangleMesh& mesh)
{
  double squared = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    for (int side = 0; side < 3; ++side)
    {
      squared =
        std::max(squared, (mesh.points[t[side]] - mesh.points[t[(side + 1) % 3]]).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

} // namespace hybridtree
