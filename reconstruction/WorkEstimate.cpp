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
constexpr double kSecondsPerPoint = 8e-6;
// With a level of detail: of each point, and of each vertex.
constexpr double kBytesPerUnused = 200.0;
constexpr double kBytesPerVertex = 3000.0;
constexpr double kSecondsPerUnused = 1e-6;
constexpr double kSecondsPerVertex = 12e-6;

} // namespace

WorkEstimate estimateWork(std::size_t points)
{
  const auto count = static_cast<double>(points);
  return { kBytesPerPoint * count, kSecondsPerPoint * count };
}

WorkEstimate estimateWork(std::size_t points, const LevelOfDetail& detail)
{
  if (points <= detail.vertices)
  {
    return estimateWork(points);
  }
  const auto count = static_cast<double>(points);
  const double vertices = detail.vertices > 0 ? static_cast<double>(detail.vertices) : count / 4.0;
  return { kBytesPerUnused * count + kBytesPerVertex * vertices,
    kSecondsPerUnused * count + kSecondsPerVertex * vertices };
}

} // namespace hybridtree
