// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/RevolvedMesh.h"

#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RingPlan.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// Triangles of the mesh, roughly: the area over that of a usual triangle, and along thin parts at
// least a few around.
double estimatedCount(const Meridian& meridian, double edgeLength)
{
  constexpr int kSamples = 16;
  double area = 0.0;
  for (const Meridian::Piece& piece : meridian.pieces())
  {
    for (int k = 0; k < kSamples; ++k)
    {
      const double radial = piece.at(piece.length * (k + 0.5) / kSamples).position.x();
      area += std::max(2.0 * kPi * radial, edgeLength) * piece.length / kSamples;
    }
  }
  return area / (0.25 * edgeLength * edgeLength);
}

} // namespace

TriangleMesh meshRevolved(const Meridian& meridian, const RevolvedFrame& frame, double edgeLength)
{
  return meshRings(revolvedRings(meridian, edgeLength), meridian.loop(), frame);
}

std::vector<Ring> revolvedRings(const Meridian& meridian, double edgeLength)
{
  requireModestCount(estimatedCount(meridian, edgeLength), edgeLength);
  return RingPlan(meridian, edgeLength).rings();
}

} // namespace hybridtree
