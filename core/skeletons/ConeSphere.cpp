// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/ConeSphere.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

ConeSphereShape hull(const Vec3& point1, const Vec3& point2, double radius1, double radius2)
{
  const Vec3 along = requireFinite("Point2", point2) - requireFinite("Point1", point1);
  const double length = along.stableNorm();
  requireNotNegative("Radius1", radius1);
  requireNotNegative("Radius2", radius2);
  if (length > std::abs(radius1 - radius2))
  {
    return { frameAlong("Point2 - Point1", point1, along), length, radius1, radius2 };
  }
  const bool first = radius1 > radius2;
  const double radius = std::max(radius1, radius2);
  return { frameAlong("Axis", first ? point1 : point2, Vec3::UnitZ()), 0.0, radius, radius };
}

} // namespace

ConeSphereSkeleton::ConeSphereSkeleton(
  const Vec3& point1, const Vec3& point2, double radius1, double radius2)
  : KernelSkeleton(hull(point1, point2, radius1, radius2))
  , point1_(point1)
  , point2_(point2)
  , radius1_(radius1)
  , radius2_(radius2)
{
}

Interval ConeSphereSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 ConeSphereSkeleton::bounds() const
{
  const auto ball = [](const Vec3& center, double radius)
  { return Box3(Vec3(center.array() - radius), Vec3(center.array() + radius)); };
  return ball(point1_, radius1_).merged(ball(point2_, radius2_));
}

std::optional<TriangleMesh> ConeSphereSkeleton::offsetMesh(double offset, double edgeLength) const
{
  const double bottom = shape_.bottom + offset;
  const double top = shape_.top + offset;
  if (bottom + top == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  if (shape_.length == 0.0)
  {
    return meshRoundedBox(
      { shape_.frame.origin, Mat3::Identity(), Vec3::Zero() }, bottom, edgeLength);
  }
  // Heights from the middle, for the symmetric one.
  const double h = 0.5 * shape_.length;
  const double slope = std::asin((shape_.bottom - shape_.top) / shape_.length);
  const Vec2 normal(std::cos(slope), std::sin(slope));
  const Vec2 lower(0.0, -h);
  const Vec2 upper(0.0, h);
  constexpr double kRightAngle = 0.5 * 3.14159265358979323846;
  Meridian meridian(Meridian::Kind::AxisToAxis, shape_.bottom == shape_.top);
  meridian.addArc(lower, bottom, -kRightAngle, slope);
  meridian.addLine(lower + bottom * normal, upper + top * normal);
  meridian.addArc(upper, top, slope, kRightAngle);
  AxisFrame frame = shape_.frame;
  frame.origin += h * frame.axis;
  return meshRevolved(meridian, frame, edgeLength);
}

SkeletonPtr ConeSphereSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<ConeSphereSkeleton>(
    map * point1_, map * point2_, scale * radius1_, scale * radius2_);
}

Parameters ConeSphereSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  parameters.set("radius1", radius1_);
  parameters.set("radius2", radius2_);
  return parameters;
}

SkeletonPtr ConeSphereSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<ConeSphereSkeleton>(parameters.getVec3("point1"),
    parameters.getVec3("point2"), parameters.getDouble("radius1"), parameters.getDouble("radius2"));
}

} // namespace hybridtree
