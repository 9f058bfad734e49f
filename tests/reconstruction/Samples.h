// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "tests/support/Random.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybridtree::test
{

/// Points drawn at random from a mesh's surface, every piece of area alike: no two evenly spaced.
inline std::vector<Vec3> randomSurfacePoints(
  const TriangleMesh& mesh, std::size_t count, std::uint64_t seed)
{
  std::vector<double> area;
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area.push_back(sum += 0.5 * areaNormal(mesh, t).norm());
  }
  Random random(seed);
  std::vector<Vec3> points;
  while (points.size() < count)
  {
    const auto at = std::upper_bound(area.begin(), area.end() - 1, random.uniform(0.0, sum));
    const Triangle& triangle = mesh.triangles[at - area.begin()];
    const double u = std::sqrt(random.unit());
    const double v = random.unit();
    points.push_back((1.0 - u) * mesh.points[triangle[0]] +
      u * ((1.0 - v) * mesh.points[triangle[1]] + v * mesh.points[triangle[2]]));
  }
  return points;
}

inline std::vector<Vec3> randomSphere(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points(count);
  std::generate(points.begin(), points.end(), [&] { return random.direction(); });
  return points;
}

/// Evenly distributed over the area of a torus about the z axis.
inline std::vector<Vec3> randomTorus(
  double ring, double tube, std::size_t count, std::uint64_t seed)
{
  const double twoPi = 2.0 * std::acos(-1.0);
  Random random(seed);
  std::vector<Vec3> points;
  while (points.size() < count)
  {
    const double u = random.uniform(0.0, twoPi);
    const double v = random.uniform(0.0, twoPi);
    const double r = ring + tube * std::cos(v);
    if (random.chance(r / (ring + tube)))
    {
      points.push_back({ r * std::cos(u), r * std::sin(u), tube * std::sin(v) });
    }
  }
  return points;
}

inline double distanceToTorus(const Vec3& p, double ring, double tube)
{
  return std::abs(std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube);
}

} // namespace hybridtree::test
