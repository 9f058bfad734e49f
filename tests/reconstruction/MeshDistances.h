// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshDistance.h"
#include "core/mesh/TriangleMesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace hybridtree::test
{

/// Of each point, the distance to the mesh.
inline std::vector<double> distances(const std::vector<Vec3>& points, const TriangleMesh& mesh)
{
  const std::size_t count = points.size();
  std::vector<double> x(count);
  std::vector<double> y(count);
  std::vector<double> z(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    x[k] = points[k].x();
    y[k] = points[k].y();
    z[k] = points[k].z();
  }
  std::vector<double> result(count);
  MeshDistance(std::make_shared<TriangleMesh>(mesh))
    .distance({ x.data(), y.data(), z.data(), count }, std::numeric_limits<double>::infinity(),
      result.data());
  return result;
}

/// Of the point that is farthest from the mesh.
inline double farthest(const std::vector<Vec3>& points, const TriangleMesh& mesh)
{
  const std::vector<double> all = distances(points, mesh);
  return *std::max_element(all.begin(), all.end());
}

} // namespace hybridtree::test
