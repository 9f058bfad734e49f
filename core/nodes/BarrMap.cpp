// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BarrMap.h"

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// Below this many radians a bend moves nothing by more than rounding.
constexpr double kNoAngle = 1e-15;

// Where the bend is singular its Jacobian is taken at this distance, in radii, from the axis.
constexpr double kNearAxis = 1e-12;

double along(double t, double begin, double end)
{
  return (std::clamp(t, begin, end) - begin) / (end - begin);
}

Interval component(const Box3& box, int axis)
{
  return { box.min()[axis], box.max()[axis] };
}

// Value of a rate that is `inside` within the range and `outside` beyond, over an interval of t.
// At the ends themselves both one-sided values count.
Interval zoned(Interval t, double begin, double end, Interval inside, double outside)
{
  const bool touchesInside = t.max >= begin && t.min <= end;
  const bool touchesOutside = t.min <= begin || t.max >= end;
  if (!touchesInside)
  {
    return { outside, outside };
  }
  return touchesOutside ? hull(inside, { outside, outside }) : inside;
}

bool within(double t, double begin, double end)
{
  return begin <= t && t <= end;
}

Vec3 turned(const Vec3& p, double angle)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return { c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
}

// Jacobian of turned(p, angle(t)), slope = d angle / dt.
Mat3 twistJacobian(const Vec3& p, double angle, double slope)
{
  const Vec3 image = turned(p, angle);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat3 j;
  j << c, -s, -slope * image[1], s, c, slope * image[0], 0.0, 0.0, 1.0;
  return j;
}

MatrixInterval twistJacobianOver(const Box3& box, const TwistMap& map, double sign)
{
  const Interval t = component(box, 2);
  const double rate = sign * map.angle / (map.end - map.begin);
  const Interval turn = rate * (clamped(t, map.begin, map.end) - Interval{ map.begin, map.begin });
  const Interval slope = zoned(t, map.begin, map.end, { rate, rate }, 0.0);
  const Interval c = cosRange(turn);
  const Interval s = sinRange(turn);
  const Interval x = component(box, 0);
  const Interval y = component(box, 1);
  return MatrixInterval({ c, -s, -(slope * (s * x + c * y)), s, c, slope * (c * x - s * y),
    { 0, 0 }, { 0, 0 }, { 1, 1 } });
}

} // namespace

// --- twist
// ----------------------------------------------------------------------------------------

Vec3 TwistMap::forward(const Vec3& p) const
{
  return turned(p, angle * along(p[2], begin, end));
}

Vec3 TwistMap::inverse(const Vec3& p) const
{
  return turned(p, -angle * along(p[2], begin, end));
}

Mat3 TwistMap::jacobian(const Vec3& p) const
{
  const double slope = within(p[2], begin, end) ? angle / (end - begin) : 0.0;
  return twistJacobian(p, angle * along(p[2], begin, end), slope);
}

Mat3 TwistMap::jacobianInverse(const Vec3& p) const
{
  const double slope = within(p[2], begin, end) ? angle / (end - begin) : 0.0;
  return twistJacobian(this->forward(p), -angle * along(p[2], begin, end), -slope);
}

MatrixInterval TwistMap::jacobianOver(const Box3& box) const
{
  return twistJacobianOver(box, *this, 1.0);
}

std::optional<MatrixInterval> TwistMap::inverseJacobianOver(const Box3& box) const
{
  return twistJacobianOver(box, *this, -1.0);
}

Box3 TwistMap::inverseExtent(const Box3& box) const
{
  const Vec3 far = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  const double radius = std::hypot(far[0], far[1]);
  return Box3(Vec3(-radius, -radius, box.min()[2]), Vec3(radius, radius, box.max()[2]));
}

// --- taper
// ----------------------------------------------------------------------------------------

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

// --- bend
// ----------------------------------------------------------------------------------------- With k
// = angle / (end - begin), tHat = clamp(t), theta = k (tHat - begin), C and S its cosine and sine
// (MATH: the bend of Barr 1984, centred on the beginning of the range):
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

// --- in a frame
// -----------------------------------------------------------------------------------

template <typename Map>
FramedWarp<Map>::FramedWarp(const Map& map, const Affine3& frame)
  : map_(map), frame_(frame), frameInverse_(frame.inverse())
{
}

template <typename Map>
void FramedWarp<Map>::forward(PointBatch points, VectorBatch image) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    image.set(k, frame_ * map_.forward(frameInverse_ * points[k]));
  }
}

template <typename Map>
void FramedWarp<Map>::inverse(PointBatch points, VectorBatch preimage) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    preimage.set(k, frame_ * map_.inverse(frameInverse_ * points[k]));
  }
}

template <typename Map>
void FramedWarp<Map>::pullBack(PointBatch preimages, VectorBatch gradient) const
{
  const Mat3 toFrame = frame_.linear().transpose();
  const Mat3 fromFrame = frameInverse_.linear().transpose();
  for (std::size_t k = 0; k < preimages.size; ++k)
  {
    const Mat3 j = map_.jacobianInverse(frameInverse_ * preimages[k]);
    gradient.set(k, fromFrame * (j.transpose() * (toFrame * gradient[k])));
  }
}

template <typename Map>
Box3 FramedWarp<Map>::preimageBounds(const Box3& box) const
{
  if (box.isEmpty())
  {
    return box;
  }
  const Box3 local = transformed(box, frameInverse_);
  Box3 bounds = transformed(map_.inverseExtent(local), frame_);
  if (const std::optional<MatrixInterval> jacobian = map_.inverseJacobianOver(local))
  {
    // Mean value theorem about the centre, entry by entry.
    const Vec3 center = frame_ * map_.inverse(frameInverse_ * box.center());
    const Vec3 reach =
      jacobian->between(frame_.linear(), frameInverse_.linear()).extent(0.5 * box.sizes());
    bounds = bounds.intersection(Box3(Vec3(center - reach), Vec3(center + reach)));
  }
  return widened(bounds);
}

template <typename Map>
Box3 FramedWarp<Map>::imageBounds(const Box3& box) const
{
  return boundsByCells(box,
    [&](const Box3& cell)
    {
      const Vec3 center = frame_ * map_.forward(frameInverse_ * cell.center());
      const Box3 local = transformed(cell, frameInverse_);
      const Vec3 reach = map_.jacobianOver(local)
                           .between(frame_.linear(), frameInverse_.linear())
                           .extent(0.5 * cell.sizes());
      const Box3 byRate(Vec3(center - reach), Vec3(center + reach));
      const Box3 extent = widened(transformed(map_.forwardExtent(local), frame_));
      return CellImage{ center, byRate.intersection(extent) };
    });
}

template class FramedWarp<TwistMap>;
template class FramedWarp<TaperMap>;
template class FramedWarp<BendMap>;

} // namespace hybridtree
