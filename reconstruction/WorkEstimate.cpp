// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/WorkEstimate.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Peak of the process: 950 to 1000 on closed surfaces; 1400 to 1600 where the empty balls are
// asked, on open surfaces, and in volumes, which have more tetrahedra; up to 3100 where few points
// are far apart around a wide hole.
constexpr double kBytesPerPoint = 1800.0;
constexpr double kBytesPerTetrahedron = 200.0;
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

std::size_t mostTetrahedra(std::size_t bytes)
{
  return static_cast<std::size_t>(static_cast<double>(bytes) / kBytesPerTetrahedron);
}

WorkEstimate estimateWork(std::size_t points, const Box3& bounds, const LevelOfDetail& detail)
{
  if (points <= detail.vertices)
  {
    return estimateWork(points);
  }
  const auto count = static_cast<double>(points);
  double vertices = static_cast<double>(detail.vertices);
  if (detail.vertices == 0)
  {
    const double diagonal = bounds.isEmpty() ? 0.0 : bounds.diagonal().norm();
    const double wanted = kVerticesPerTolerance * diagonal / detail.tolerance;
    vertices = wanted >= 0.0 && wanted < count ? wanted : count;
  }
  return { kBytesPerUnused * count + kBytesPerVertex * vertices,
    kSecondsPerUnused * count + kSecondsPerVertex * vertices };
}

} // namespace hybridtree
