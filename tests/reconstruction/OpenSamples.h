// SPDX-License-Identifier: BSD-3-Clause
// What tests of open surfaces share: samples with a rim, and what holds for every sheet.
#pragma once

#include "core/mesh/MeshChecks.h"
#include "reconstruction/Convection.h"
#include "tests/reconstruction/Samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace hybridtree::test
{

inline ConvectionOptions open()
{
  ConvectionOptions options;
  options.closeHoles = false;
  return options;
}

inline std::vector<Vec3> onlyWhere(
  std::vector<Vec3> points, const std::function<bool(const Vec3&)>& keep)
{
  points.erase(
    std::remove_if(points.begin(), points.end(), [&](const Vec3& p) { return !keep(p); }),
    points.end());
  return points;
}

// Loops of open edges. \pre the mesh is a manifold with boundary.
inline std::size_t borderLoops(const TriangleMesh& mesh)
{
  std::map<std::int32_t, std::int32_t> next;
  for (const Triangle& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      next[t[k]] = -1;
    }
  }
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    if (edges.count({ edge.second, edge.first }) == 0)
    {
      next[edge.first] = edge.second;
    }
  }
  std::size_t loops = 0;
  for (auto& [from, to] : next)
  {
    if (to >= 0)
    {
      ++loops;
      for (std::int32_t at = from; at >= 0;)
      {
        at = std::exchange(next[at], -1);
      }
    }
  }
  return loops;
}

// An oriented manifold with boundary, of points of the input.
inline void expectManifold(const ReconstructedSurface& surface, const std::vector<Vec3>& points)
{
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.oriented() && report.edgeManifold() && report.vertexManifold())
    << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  ASSERT_EQ(surface.pointIds.size(), surface.mesh.points.size());
  ASSERT_EQ(surface.mesh.normals.size(), surface.mesh.points.size());
  for (std::size_t k = 0; k < surface.pointIds.size(); ++k)
  {
    ASSERT_EQ(surface.mesh.points[k], points.at(surface.pointIds[k]));
  }
}

// A landscape: neither closed nor nearly so.
inline std::vector<Vec3> landscape(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
  {
    const double x = random.uniform(0.0, 4.0);
    const double y = random.uniform(0.0, 3.0);
    p = { x, y, 0.3 * std::sin(3.0 * x) * std::cos(2.0 * y) };
  }
  return points;
}

} // namespace hybridtree::test
