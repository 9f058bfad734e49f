// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BendMap.h"

#include "core/nodes/BarrZones.h"

#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// Below this many radians a bend moves nothing by more than rounding.
constexpr double kNoAngle = 1e-15;

// Where the bend is singular its Jacobian is taken at this distance, in radii, from the axis.
constexpr double kNearAxis = 1e-12;

} // namespace

// With k = angle / (end - begin), tHat = clamp(t), theta = k (tHat - begin), C and S its cosine and
// sine (the bend of Barr 1984, centred on the beginning of the range):
//   N = C n + S (t - tHat) + (1 - C) / k
//   T = begin + C (t - tHat) - S n + S / k

bool BendMap::isIdentity() const
{
  return std::abs(angle) < kNoAngle;
}

Vec3 BendMap::forward(const Vec3& p) const
{
  if (this->isIdentity())
  {
    return p;
  }
  const double k = this->rate();
  const double beyond = p[2] - std::clamp(p[2], begin, end);
  const double theta = angle * along(p[2], begin, end);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double half = std::sin(0.5 * theta);
  return { c * p[0] + s * beyond + 2.0 * half * half / k, p[1],
    begin + c * beyond - s * p[0] + s / k };
}

Vec3 BendMap::inverse(const Vec3& p) const
{
  if (this->isIdentity())
  {
    return p;
  }
  const double k = this->rate();
  const double sign = k > 0.0 ? 1.0 : -1.0;
  const double a = p[2] - begin;
  const double toAxis = sign * (1.0 / k - p[0]); // > 0 on the shape's side of the axis
  double theta = std::atan2(sign * a, toAxis);
  // Brought within half a turn of the middle of the bend, where 0 <= |angle| / 2 < pi.
  const double middle = 0.5 * angle;
  if (theta <= middle - kPi)
  {
    theta += 2.0 * kPi;
  }
  else if (theta > middle + kPi)
  {
    theta -= 2.0 * kPi;
  }
  const double low = std::min(0.0, angle);
  const double high = std::max(0.0, angle);
  if (theta >= low && theta <= high)
  {
    const double radius = std::hypot(a, toAxis);
    // 1/k - sign * radius; where both are large, their difference in a form that keeps its digits.
    const double n =
      toAxis > 0.0 ? p[0] - sign * a * (a / (toAxis + radius)) : 1.0 / k - sign * radius;
    return { n, p[1], std::clamp(begin + theta / k, begin, end) };
  }
  theta = std::clamp(theta, low, high);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double half = std::sin(0.5 * theta);
  // theta = 0 is the beginning of the range, theta = angle its end, whatever the sign.
  const double hat = theta == 0.0 ? begin : end;
  return { c * p[0] - s * a + 2.0 * half * half / k, p[1], hat + c * a + s * p[0] - s / k };
}

Mat3 BendMap::jacobian(const Vec3& p) const
{
  const double theta = angle * along(p[2], begin, end);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double stretch = within(p[2], begin, end) ? 1.0 - this->rate() * p[0] : 1.0;
  Mat3 j;
  j << c, 0.0, s * stretch, 0.0, 1.0, 0.0, -s, 0.0, c * stretch;
  return j;
}

Mat3 BendMap::jacobianInverse(const Vec3& p) const
{
  const double theta = angle * along(p[2], begin, end);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double stretch = within(p[2], begin, end) ? 1.0 - this->rate() * p[0] : 1.0;
  const double shrink = 1.0 / std::copysign(std::max(std::abs(stretch), kNearAxis), stretch);
  Mat3 j;
  j << c, 0.0, -s, 0.0, 1.0, 0.0, shrink * s, 0.0, shrink * c;
  return j;
}

MatrixInterval BendMap::jacobianOver(const Box3& box) const
{
  const Interval t = component(box, 2);
  const Interval theta = angle * Interval{ along(t.min, begin, end), along(t.max, begin, end) };
  const Interval c = cosRange(theta);
  const Interval s = sinRange(theta);
  const Interval stretch =
    zoned(t, begin, end, Interval{ 1.0, 1.0 } - this->rate() * component(box, 0), 1.0);
  const Interval zero{ 0.0, 0.0 };
  return MatrixInterval({ c, zero, s * stretch, zero, { 1.0, 1.0 }, zero, -s, zero, c * stretch });
}

// Polar angles about the axis of the points of the box, in one piece around that of its centre;
// unbounded when the box touches the axis.
Interval BendMap::polarAngle(const Box3& box) const
{
  const double k = this->rate();
  const double sign = k > 0.0 ? 1.0 : -1.0;
  const auto relative = [&](double n, double t) -> Eigen::Vector2d {
    return { sign * (1.0 / k - n), sign * (t - begin) };
  };
  const Eigen::Vector2d low = relative(box.min()[0], box.min()[2]);
  const Eigen::Vector2d high = relative(box.max()[0], box.max()[2]);
  if (low[0] * high[0] <= 0.0 && low[1] * high[1] <= 0.0)
  {
    return { -10.0, 10.0 };
  }
  const Eigen::Vector2d center = 0.5 * (low + high);
  const double middle = std::atan2(center[1], center[0]);
  Interval angles{ middle, middle };
  for (int corner = 0; corner < 4; ++corner)
  {
    const Eigen::Vector2d v(corner & 1 ? low[0] : high[0], corner & 2 ? low[1] : high[1]);
    const double off = std::atan2(center[0] * v[1] - center[1] * v[0], center.dot(v));
    angles = hull(angles, { middle + off, middle + off });
  }
  return angles;
}

std::optional<MatrixInterval> BendMap::inverseJacobianOver(const Box3& box) const
{
  if (this->isIdentity())
  {
    return MatrixInterval(Mat3::Identity(), Mat3::Zero());
  }
  Interval polar = this->polarAngle(box);
  const double middle = 0.5 * angle;
  for (const double turn : { -2.0 * kPi, 2.0 * kPi })
  {
    if (std::abs(0.5 * (polar.min + polar.max) + turn - middle) <
      std::abs(0.5 * (polar.min + polar.max) - middle))
    {
      polar = polar + Interval{ turn, turn };
    }
  }
  if (polar.min <= middle - kPi || polar.max >= middle + kPi)
  {
    return std::nullopt; // the axis, or the half-plane where the two straight ends meet
  }
  const double low = std::min(0.0, angle);
  const double high = std::max(0.0, angle);
  const double k = this->rate();
  const auto nearest = [&](double value, Interval range) {
    return std::max({ 0.0, range.min - value, value - range.max });
  };
  const auto farthest = [&](double value, Interval range)
  { return std::max(std::abs(range.min - value), std::abs(range.max - value)); };
  const Interval n = component(box, 0);
  const Interval t = component(box, 2);
  const Interval radius{ std::hypot(nearest(1.0 / k, n), nearest(begin, t)),
    std::hypot(farthest(1.0 / k, n), farthest(begin, t)) };
  const double away = std::max(radius.min, kNearAxis / std::abs(k));
  const Interval shrink = zoned(polar, low, high,
    { 1.0 / (std::abs(k) * std::max(radius.max, away)), 1.0 / (std::abs(k) * away) }, 1.0);
  const Interval theta = clamped(polar, low, high);
  const Interval c = cosRange(theta);
  const Interval s = sinRange(theta);
  const Interval zero{ 0.0, 0.0 };
  return MatrixInterval({ c, zero, -s, zero, { 1.0, 1.0 }, zero, shrink * s, zero, shrink * c });
}

Box3 BendMap::inverseExtent(const Box3& box) const
{
  if (this->isIdentity())
  {
    return box;
  }
  // Distance from the axis is kept, in the bent zone and in the straight ones.
  const double axis = 1.0 / this->rate();
  const double radius =
    std::hypot(std::max(std::abs(box.min()[0] - axis), std::abs(box.max()[0] - axis)),
      std::max(std::abs(box.min()[2] - begin), std::abs(box.max()[2] - begin)));
  return Box3(Vec3(axis - radius, box.min()[1], begin - radius),
    Vec3(axis + radius, box.max()[1], end + radius));
}

Box3 BendMap::forwardExtent(const Box3& box) const
{
  if (this->isIdentity())
  {
    return box;
  }
  const double axis = 1.0 / this->rate();
  const double beyond = std::max({ begin - box.min()[2], box.max()[2] - end, 0.0 });
  const double across = std::max(std::abs(box.min()[0] - axis), std::abs(box.max()[0] - axis));
  const double radius = (1.0 + 1e-14) * std::hypot(across, beyond);
  return Box3(Vec3(axis - radius, box.min()[1], begin - radius),
    Vec3(axis + radius, box.max()[1], begin + radius));
}

bool BendMap::isOneToOneOver(const Box3& box) const
{
  if (this->isIdentity() || box.isEmpty())
  {
    return true;
  }
  const double k = this->rate();
  const double sign = k > 0.0 ? 1.0 : -1.0;
  // A straight end may reach this polar angle beyond the range before it meets the other.
  const double limit = kPi - 0.5 * std::abs(angle);
  const auto endIsFree = [&](double nearest, double farthest)
  {
    // The wedge is convex, so the corners of the part beyond the range decide.
    for (const double t : { std::max(nearest, 0.0), farthest })
    {
      for (const double n : { box.min()[0], box.max()[0] })
      {
        if (farthest > 0.0 && !(std::atan2(t, sign * (1.0 / k - n)) < limit))
        {
          return false;
        }
      }
    }
    return true;
  };
  const bool meetsRange = box.max()[2] >= begin && box.min()[2] <= end;
  const double highest = sign > 0.0 ? box.max()[0] : -box.min()[0];
  if (meetsRange && !(highest < 1.0 / std::abs(k)))
  {
    return false;
  }
  return endIsFree(box.min()[2] - end, box.max()[2] - end) &&
    endIsFree(begin - box.max()[2], begin - box.min()[2]);
}

} // namespace hybridtree
