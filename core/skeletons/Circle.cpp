// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Circle.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

CircleShape circleShape(const Vec3& center, const Vec3& normal, double radius)
{
  const Vec3 unit = requireDirection("Normal", normal);
  return { requireFinite("Center", center), unit, anyAcross(unit),
    requireNotNegative("Radius", radius) };
}

} // namespace

CircleSkeleton::CircleSkeleton(const Vec3& center, const Vec3& normal, double radius)
  : KernelSkeleton(circleShape(center, normal, radius))
{
}

Interval CircleSkeleton::distanceRange(const Box3& box) const
{
  const AxisRange range = axisRange(box, shape_.center, shape_.normal);
  const double lowHeight = std::max({ 0.0, range.height.min, -range.height.max });
  const double highHeight = std::max(-range.height.min, range.height.max);
  const double lowAcross =
    std::max({ 0.0, range.radial.min - shape_.radius, shape_.radius - range.radial.max });
  const double highAcross = std::max(
    std::abs(range.radial.min - shape_.radius), std::abs(range.radial.max - shape_.radius));

  // Height and radius taken apart forget that no point of the box may have both; the distance
  // cannot change faster than the point moves, either.
  return withinReach(
    { std::hypot(lowHeight, lowAcross), std::hypot(highHeight, highAcross) }, *this, box);
}

Box3 CircleSkeleton::bounds() const
{
  return discBounds(shape_.center, shape_.normal, shape_.radius);
}

std::optional<TriangleMesh> CircleSkeleton::offsetMesh(double offset, double edgeLength) const
{
  if (offset == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  if (shape_.radius == 0.0)
  {
    return meshRoundedBox({ shape_.center, Mat3::Identity(), Vec3::Zero() }, offset, edgeLength);
  }
  if (offset >= shape_.radius)
  {
    return std::nullopt;
  }
  return meshTorus(shape_, offset, edgeLength);
}

SkeletonPtr CircleSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<CircleSkeleton>(
    map * shape_.center, map.linear() * shape_.normal, scale * shape_.radius);
}

Parameters CircleSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("center", shape_.center);
  parameters.set("normal", shape_.normal);
  parameters.set("radius", shape_.radius);
  return parameters;
}

SkeletonPtr CircleSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<CircleSkeleton>(
    parameters.getVec3("center"), parameters.getVec3("normal"), parameters.getDouble("radius"));
}

} // namespace hybridtree
