// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/HollowCylinder.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

constexpr double kRightAngle = 0.5 * 3.14159265358979323846;

double requireInner(double inner, double outer)
{
  if (!(requireNotNegative("InnerRadius", inner) <= outer))
  {
    std::ostringstream allowed;
    allowed << "at most OuterRadius, which is " << outer;
    throw InvalidParameter("InnerRadius", inner, allowed.str());
  }
  return inner;
}

} // namespace

HollowCylinderSkeleton::HollowCylinderSkeleton(
  const Vec3& point1, const Vec3& point2, double outerRadius, double innerRadius)
  : KernelSkeleton({ frameBetween(point1, point2), 0.5 * (point2 - point1).stableNorm(),
      requireNotNegative("OuterRadius", outerRadius), requireInner(innerRadius, outerRadius) })
  , point1_(point1)
  , point2_(point2)
{
}

Interval HollowCylinderSkeleton::distanceRange(const Box3& box) const
{
  const AxisRange range = axisRange(box, shape_.frame.origin, shape_.frame.axis);
  if (range.radial.min >= shape_.inner)
  {
    return convexDistanceRange(*this, box); // that of the cylinder without a bore
  }
  const auto over = [&](double height) { return std::max(0.0, height - shape_.half); };
  const double lowHeight = over(std::max(range.height.min, -range.height.max));
  const double highHeight = over(std::max(-range.height.min, range.height.max));
  const double lowAcross =
    std::max({ 0.0, range.radial.min - shape_.outer, shape_.inner - range.radial.max });
  const double highAcross =
    std::max({ 0.0, range.radial.max - shape_.outer, shape_.inner - range.radial.min });
  return withinReach(
    { std::hypot(lowHeight, lowAcross), std::hypot(highHeight, highAcross) }, *this, box);
}

Box3 HollowCylinderSkeleton::bounds() const
{
  return discBounds(point1_, shape_.frame.axis, shape_.outer)
    .merged(discBounds(point2_, shape_.frame.axis, shape_.outer));
}

Meridian HollowCylinderSkeleton::meridian(double offset) const
{
  const double inner = shape_.inner;
  const double outer = shape_.outer;
  const double h = shape_.half;
  const bool bore = offset < inner;
  Meridian result(bore ? Meridian::Kind::Loop : Meridian::Kind::AxisToAxis, true);
  // The inner rim turns as far as the axis.
  const double stop = inner > 0.0 ? std::acos(std::min(1.0, inner / offset)) : kRightAngle;
  const auto lowerEnd = [&]
  {
    const double begin = bore ? 2.0 * kRightAngle : 2.0 * kRightAngle + stop;
    result.addArc({ inner, -h }, offset, begin, 3.0 * kRightAngle);
    result.addLine({ inner, -h - offset }, { outer, -h - offset });
    result.addArc({ outer, -h }, offset, -kRightAngle, 0.0);
  };
  const auto upperEnd = [&]
  {
    const double end = bore ? 2.0 * kRightAngle : 2.0 * kRightAngle - stop;
    result.addArc({ outer, h }, offset, 0.0, kRightAngle);
    result.addLine({ outer, h + offset }, { inner, h + offset });
    result.addArc({ inner, h }, offset, kRightAngle, end);
  };
  if (!bore)
  {
    lowerEnd();
    result.addLine({ outer + offset, -h }, { outer + offset, h });
    upperEnd();
    return result;
  }
  result.addLine({ outer + offset, 0.0 }, { outer + offset, h });
  upperEnd();
  result.addLine({ inner - offset, h }, { inner - offset, -h });
  lowerEnd();
  result.addLine({ outer + offset, -h }, { outer + offset, 0.0 });
  return result;
}

std::optional<TriangleMesh> HollowCylinderSkeleton::offsetMesh(
  double offset, double edgeLength) const
{
  const double wall = shape_.outer - shape_.inner + 2.0 * offset;
  if (wall == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  // Edges cut at most a quarter of the wall off the outside.
  const bool bore = offset < shape_.inner;
  const double apart = bore ? std::sqrt(2.0 * wall) * std::sqrt(shape_.outer + offset) : edgeLength;
  return meshRevolved(this->meridian(offset), shape_.frame, std::min(edgeLength, apart));
}

SkeletonPtr HollowCylinderSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<HollowCylinderSkeleton>(
    map * point1_, map * point2_, scale * shape_.outer, scale * shape_.inner);
}

Parameters HollowCylinderSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  parameters.set("outer_radius", shape_.outer);
  parameters.set("inner_radius", shape_.inner);
  return parameters;
}

SkeletonPtr HollowCylinderSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<HollowCylinderSkeleton>(parameters.getVec3("point1"),
    parameters.getVec3("point2"), parameters.getDouble("outer_radius"),
    parameters.getDouble("inner_radius"));
}

} // namespace hybridtree
