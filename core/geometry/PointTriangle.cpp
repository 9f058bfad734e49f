// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/PointTriangle.h"

#include <algorithm>

namespace hybridtree
{

NearestOnTriangle nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3* corner[3] = { &a, &b, &c };
  const Vec3 edge[3] = { b - a, c - b, a - c };
  const Vec3 normal = edge[0].cross(edge[1]);
  const double squaredNormal = normal.squaredNorm();
  const double longest =
    std::max({ edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm() });

  bool inside = squaredNormal > 1e-16 * longest * longest;
  NearestOnTriangle best{ a, (p - a).squaredNorm(), 0 };
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 toPoint = p - *corner[k];
    inside = inside && normal.cross(edge[k]).dot(toPoint) > 0.0;
    const double squaredEdge = edge[k].squaredNorm();
    const double along = edge[k].dot(toPoint);
    if (along <= 0.0 || squaredEdge == 0.0)
    {
      const double squared = toPoint.squaredNorm();
      if (squared < best.squaredDistance)
      {
        best = { *corner[k], squared, k };
      }
    }
    else if (along < squaredEdge)
    {
      const Vec3 offset = (along / squaredEdge) * edge[k];
      const double squared = (toPoint - offset).squaredNorm();
      if (squared < best.squaredDistance)
      {
        best = { *corner[k] + offset, squared, 3 + k };
      }
    }
  }
  if (inside)
  {
    const double height = normal.dot(p - a);
    const double squared = height * height / squaredNormal;
    best = { p - (height / squaredNormal) * normal, squared, NearestOnTriangle::kFace };
  }
  return best;
}

} // namespace hybridtree
