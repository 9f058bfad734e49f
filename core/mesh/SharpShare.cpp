// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SharpShare.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1 << 13;

struct Areas
{
  double sharp = 0.0;
  double all = 0.0;
};

/// Of some triangles. Without a call, which takes longer than the rest: it is asked of every mesh
/// that is shown.
Areas areasOf(const TriangleMesh& mesh, std::size_t begin, std::size_t end, double cosine)
{
  const Vec3* const points = mesh.points.data();
  const Vec3* const normals = mesh.normals.data();
  Areas areas;
  for (std::size_t t = begin; t < end; ++t)
  {
    const Triangle& c = mesh.triangles[t];
    const Vec3 origin = points[c[0]];
    const Vec3 normal = (points[c[1]] - origin).cross(points[c[2]] - origin);
    const double area = normal.norm();
    const double least =
      std::min({ normal.dot(normals[c[0]]), normal.dot(normals[c[1]]), normal.dot(normals[c[2]]) });
    areas.sharp += least < cosine * area ? area : 0.0;
    areas.all += area;
  }
  return areas;
}

} // namespace

double sharpShare(const TriangleMesh& mesh, double angle)
{
  const std::size_t count = mesh.normals.empty() ? 0 : mesh.triangles.size();
  const double cosine = std::cos(angle);
  std::vector<Areas> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    { parts[begin / kGrain] = areasOf(mesh, begin, end, cosine); });
  Areas sum;
  for (const Areas& part : parts) // in order, so that no thread changes the rounding
  {
    sum.sharp += part.sharp;
    sum.all += part.all;
  }
  return sum.all > 0.0 ? sum.sharp / sum.all : 0.0;
}

} // namespace hybridtree
