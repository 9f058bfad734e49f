// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Circle.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
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
  const Vec3 half = 0.5 * box.sizes();
  const Vec3 center = box.center() - shape_.center;

  // Height over the plane: linear, so exact.
  const double height = shape_.normal.dot(center);
  const double heightReach = shape_.normal.cwiseAbs().dot(half);
  const double lowHeight = std::max(0.0, std::abs(height) - heightReach);
  const double highHeight = std::abs(height) + heightReach;

  // Distance to the axis: convex, so the largest is at a corner, and it lies above its tangent
  // plane.
  const Vec3 radial = center - height * shape_.normal;
  const double axis = radial.norm();
  double lowAxis = 0.0;
  if (axis > 0.0)
  {
    lowAxis = std::max(0.0, axis - (radial / axis).cwiseAbs().dot(half));
  }
  double highAxis = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 p = box.corner(static_cast<Box3::CornerType>(corner)) - shape_.center;
    highAxis = std::max(highAxis, (p - shape_.normal.dot(p) * shape_.normal).norm());
  }
  const double lowAcross = std::max({ 0.0, lowAxis - shape_.radius, shape_.radius - highAxis });
  const double highAcross =
    std::max(std::abs(lowAxis - shape_.radius), std::abs(highAxis - shape_.radius));

  // Height and axis taken apart forget that no point of the box may have both; the distance cannot
  // change faster than the point moves, either.
  const double atCenter = std::hypot(height, axis - shape_.radius);
  const double reach = half.norm();
  return widenedByRounding({ std::max(std::hypot(lowHeight, lowAcross), atCenter - reach),
                             std::min(std::hypot(highHeight, highAcross), atCenter + reach) },
    box, this->bounds());
}

Box3 CircleSkeleton::bounds() const
{
  const Vec3 squaredNormal = shape_.normal.cwiseAbs2();
  const Vec3 half = shape_.radius * (Vec3::Ones() - squaredNormal).cwiseMax(0.0).cwiseSqrt();
  return Box3(Vec3(shape_.center - half), Vec3(shape_.center + half));
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
