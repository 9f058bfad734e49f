// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/WorkEstimate.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Peak of the whole process on 10^5 to 10^6 points of a bumpy sphere, and a third more: points that
// fill a volume have more tetrahedra.
constexpr double kBytesPerPoint = 1300.0;
constexpr double kSecondsPerPoint = 11e-6;
// With a level of detail: of each point, and of each vertex.
constexpr double kBytesPerUnused = 200.0;
constexpr double kBytesPerVertex = 3000.0;
constexpr double kSecondsPerUnused = 1e-6;
constexpr double kSecondsPerVertex = 12e-6;
constexpr double kVerticesPerTolerance = 7.0;

} // namespace

WorkEstimate estimateWork(std::size_t points)
{
  const auto count = static_cast<double>(points);
  return { kBytesPerPoint * count, kSecondsPerPoint * count };
}

WorkEstimate estimateWork(const std::vector<Vec3>& points, const LevelOfDetail& detail)
{
  if (points.size() <= detail.vertices)
  {
    return estimateWork(points.size());
  }
  const auto count = static_cast<double>(points.size());
  double vertices = static_cast<double>(detail.vertices);
  if (detail.vertices == 0)
  {
    Box3 box;
    for (const Vec3& point : points)
    {
      box.extend(point);
    }
    const double diagonal = points.empty() ? 0.0 : box.diagonal().norm();
    const double wanted = kVerticesPerTolerance * diagonal / detail.tolerance;
    vertices = wanted >= 0.0 && wanted < count ? wanted : count;
  }
  return { kBytesPerUnused * count + kBytesPerVertex * vertices,
    kSecondsPerUnused * count + kSecondsPerVertex * vertices };
}

} // namespace hybridtree
