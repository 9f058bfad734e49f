// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/FeatureEdges.h"

#include "core/mesh/HalfEdges.h"

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{

double FeatureEdge::distance(const Vec3& p) const
{
  const Vec3 way = to - from;
  const double share = std::clamp(way.dot(p - from) / way.squaredNorm(), 0.0, 1.0);
  return (from + share * way - p).norm();
}

std::vector<FeatureEdge> featureEdges(const TriangleMesh& mesh, double angle)
{
  const double cosine = std::cos(angle * std::acos(-1.0) / 180.0);
  const HalfEdges edges = halfEdges(mesh.triangles);
  std::vector<FeatureEdge> found;
  for (std::size_t h = 0; h < edges.opposite.size(); ++h)
  {
    const auto twin = static_cast<std::size_t>(edges.opposite[h]);
    const Vec3 here = areaNormal(mesh, h / 3).normalized();
    if (h < twin && here.dot(areaNormal(mesh, twin / 3).normalized()) < cosine)
    {
      const Triangle& c = mesh.triangles[h / 3];
      found.push_back({ mesh.points[c[h % 3]], mesh.points[c[(h + 1) % 3]] });
    }
  }
  return found;
}

bool isCovered(const std::vector<FeatureEdge>& edges, const Vec3& p, double reach)
{
  return std::any_of(
    edges.begin(), edges.end(), [&](const FeatureEdge& edge) { return edge.distance(p) < reach; });
}

} // namespace hybridtree::test
