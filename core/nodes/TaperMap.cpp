// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/TaperMap.h"

#include "core/nodes/BarrZones.h"

#include <cmath>

namespace hybridtree
{

Vec3 TaperMap::forward(const Vec3& p) const
{
  const double scale = 1.0 + (factor - 1.0) * along(p[2], begin, end);
  return { scale * p[0], scale * p[1], p[2] };
}

Vec3 TaperMap::inverse(const Vec3& p) const
{
  const double scale = 1.0 + (factor - 1.0) * along(p[2], begin, end);
  return { p[0] / scale, p[1] / scale, p[2] };
}

Mat3 TaperMap::jacobian(const Vec3& p) const
{
  const double scale = 1.0 + (factor - 1.0) * along(p[2], begin, end);
  const double slope = within(p[2], begin, end) ? (factor - 1.0) / (end - begin) : 0.0;
  Mat3 j;
  j << scale, 0.0, slope * p[0], 0.0, scale, slope * p[1], 0.0, 0.0, 1.0;
  return j;
}

Mat3 TaperMap::jacobianInverse(const Vec3& p) const
{
  const double scale = 1.0 + (factor - 1.0) * along(p[2], begin, end);
  const double slope = within(p[2], begin, end) ? (factor - 1.0) / (end - begin) : 0.0;
  Mat3 j;
  j << 1.0 / scale, 0.0, -slope * p[0] / scale, 0.0, 1.0 / scale, -slope * p[1] / scale, 0.0, 0.0,
    1.0;
  return j;
}

MatrixInterval TaperMap::jacobianOver(const Box3& box) const
{
  const Interval t = component(box, 2);
  const double rate = (factor - 1.0) / (end - begin);
  const Interval scale = Interval{ 1.0, 1.0 } +
    (factor - 1.0) * Interval{ along(t.min, begin, end), along(t.max, begin, end) };
  const Interval slope = zoned(t, begin, end, { rate, rate }, 0.0);
  const Interval zero{ 0.0, 0.0 };
  return MatrixInterval({ scale, zero, slope * component(box, 0), zero, scale,
    slope * component(box, 1), zero, zero, { 1.0, 1.0 } });
}

std::optional<MatrixInterval> TaperMap::inverseJacobianOver(const Box3& box) const
{
  const Interval t = component(box, 2);
  const double rate = (factor - 1.0) / (end - begin);
  const Interval scale = Interval{ 1.0, 1.0 } +
    (factor - 1.0) * Interval{ along(t.min, begin, end), along(t.max, begin, end) };
  const Interval shrink{ 1.0 / scale.max, 1.0 / scale.min };
  const Interval slope = zoned(t, begin, end, -(rate * (shrink * shrink)), 0.0);
  const Interval zero{ 0.0, 0.0 };
  return MatrixInterval({ shrink, zero, slope * component(box, 0), zero, shrink,
    slope * component(box, 1), zero, zero, { 1.0, 1.0 } });
}

Box3 TaperMap::inverseExtent(const Box3& box) const
{
  const Interval shrink = hull({ 1.0 / (1.0 + (factor - 1.0) * along(box.min()[2], begin, end)),
                                 1.0 / (1.0 + (factor - 1.0) * along(box.min()[2], begin, end)) },
    { 1.0 / (1.0 + (factor - 1.0) * along(box.max()[2], begin, end)),
      1.0 / (1.0 + (factor - 1.0) * along(box.max()[2], begin, end)) });
  const Interval n = shrink * component(box, 0);
  const Interval b = shrink * component(box, 1);
  return Box3(Vec3(n.min, b.min, box.min()[2]), Vec3(n.max, b.max, box.max()[2]));
}

Box3 TaperMap::forwardExtent(const Box3& box) const
{
  const Interval scale = Interval{ 1.0, 1.0 } +
    (factor - 1.0) * Interval{ along(box.min()[2], begin, end), along(box.max()[2], begin, end) };
  const Interval n = scale * component(box, 0);
  const Interval b = scale * component(box, 1);
  return Box3(Vec3(n.min, b.min, box.min()[2]), Vec3(n.max, b.max, box.max()[2]));
}

} // namespace hybridtree
