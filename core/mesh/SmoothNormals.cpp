// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SmoothNormals.h"

#include <cmath>

namespace hybridtree
{

void smoothNormals(TriangleMesh& mesh, const SmoothNormalsOptions& options)
{
  const double leastCosine = std::cos(options.creaseAngle);
  std::vector<Vec3> sums;
  for (int round = 0; round < options.rounds; ++round)
  {
    sums = mesh.normals;
    for (const Triangle& corners : mesh.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        // In a closed mesh the other triangle of the edge goes through it the other way.
        const std::int32_t from = corners[k];
        const std::int32_t to = corners[(k + 1) % 3];
        if (mesh.normals[from].dot(mesh.normals[to]) > leastCosine)
        {
          sums[to] += mesh.normals[from];
        }
      }
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      const double length = sums[k].norm();
      if (length > 0.0)
      {
        mesh.normals[k] = sums[k] / length;
      }
    }
  }
}

} // namespace hybridtree
