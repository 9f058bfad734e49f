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

} // namespace

double sharpShare(const TriangleMesh& mesh, double angle)
{
  const std::size_t count = mesh.normals.empty() ? 0 : mesh.triangles.size();
  const double cosine = std::cos(angle);
  std::vector<Areas> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      Areas& part = parts[begin / kGrain];
      for (std::size_t t = begin; t < end; ++t)
      {
        const Vec3 normal = areaNormal(mesh, t);
        const double area = normal.norm();
        const Triangle& corner = mesh.triangles[t];
        double least = area;
        for (const std::int32_t point : corner)
        {
          least = std::min(least, normal.dot(mesh.normals[std::size_t(point)]));
        }
        part.sharp += least < cosine * area ? area : 0.0;
        part.all += area;
      }
    });
  Areas sum;
  for (const Areas& part : parts) // in order, so that no thread changes the rounding
  {
    sum.sharp += part.sharp;
    sum.all += part.all;
  }
  return sum.all > 0.0 ? sum.sharp / sum.all : 0.0;
}

} // namespace hybridtree
