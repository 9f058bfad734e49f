// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/RoundShapes.h"

#include "core/skeletons/Validate.h"

#include <cmath>

namespace hybridtree
{

AxisFrame frameAlong(const std::string& name, const Vec3& origin, const Vec3& axis)
{
  const Vec3 unit = requireDirection(name, axis);
  return { origin, unit, anyAcross(unit) };
}

AxisFrame frameBetween(const Vec3& point1, const Vec3& point2)
{
  const Vec3 along = requireFinite("Point2", point2) - requireFinite("Point1", point1);
  return frameAlong("Point2 - Point1", point1 + 0.5 * along, along);
}

Box3 discBounds(const Vec3& center, const Vec3& normal, double radius)
{
  const Vec3 squaredNormal = normal.cwiseAbs2();
  const Vec3 half = radius * (Vec3::Ones() - squaredNormal).cwiseMax(0.0).cwiseSqrt();
  return Box3(Vec3(center - half), Vec3(center + half));
}

Meridian roundedMeridian(const std::vector<Vec2>& corners, double radius, bool symmetric)
{
  Meridian meridian(Meridian::Kind::AxisToAxis, symmetric);
  double angle = -0.5 * double(EIGEN_PI); // of the normal
  Vec2 last = corners.front();
  for (std::size_t k = 1; k < corners.size(); ++k)
  {
    const Vec2 along = corners[k] - last;
    if (along.x() == 0.0 && along.y() == 0.0)
    {
      continue;
    }
    // At the turn of the section, by the normal of the side that follows.
    const double next = std::atan2(-along.x(), along.y());
    meridian.addArc(last, radius, angle, next);
    angle = next;
    const Vec2 out = radius * Vec2(std::cos(angle), std::sin(angle));
    meridian.addLine(last + out, corners[k] + out);
    last = corners[k];
  }
  meridian.addArc(last, radius, angle, 0.5 * double(EIGEN_PI));
  return meridian;
}

} // namespace hybridtree
