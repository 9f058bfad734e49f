// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/TubeClearance.h"

#include "core/geometry/IntervalMath.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostPieces = 4000;
constexpr int kMostHalvings = 14;
constexpr double kLargestTurn = 0.3;
// Tangents that differ by less are the same but for rounding.
constexpr double kCorner = 1e-6;

double angle(const Vec3& a, const Vec3& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// A short part of the curve, between two points and within `sag` of their chord.
struct Piece
{
  Vec3 a;
  Vec3 b;
  double sag;
  double radius;   // of the tube, at most
  double turnFrom; // of the curve, up to its start
  double turnTo;
};

double squaredPointSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double squared = edge.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).squaredNorm();
}

// Lines that pass inside of both segments are nearer than any end; else an end is nearest.
double segmentDistance(const Piece& p, const Piece& q)
{
  double squared =
    std::min({ squaredPointSegment(p.a, q.a, q.b), squaredPointSegment(p.b, q.a, q.b),
      squaredPointSegment(q.a, p.a, p.b), squaredPointSegment(q.b, p.a, p.b) });
  const Vec3 u = p.b - p.a;
  const Vec3 v = q.b - q.a;
  const Vec3 w = p.a - q.a;
  const double uv = u.dot(v);
  const double determinant = u.squaredNorm() * v.squaredNorm() - uv * uv;
  if (determinant > 1e-12 * u.squaredNorm() * v.squaredNorm())
  {
    const double s = (uv * v.dot(w) - v.squaredNorm() * u.dot(w)) / determinant;
    const double t = (u.squaredNorm() * v.dot(w) - uv * u.dot(w)) / determinant;
    if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)
    {
      squared = std::min(squared, (w + s * u - t * v).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

// Bernstein coefficients of the product of c' and c'', of the edges of the control polygon:
// c' = 3 sum e_k B_k, c'' = 6 ((e1 - e0)(1 - t) + (e2 - e1) t).
template <class Multiply>
auto slopeTimesBend(const std::array<Vec3, 3>& edge, const Multiply& multiply)
{
  const Vec3 b0 = edge[1] - edge[0];
  const Vec3 b1 = edge[2] - edge[1];
  return std::array<decltype(multiply(b0, b1)), 4>{ 18.0 * multiply(edge[0], b0),
    6.0 * multiply(edge[0], b1) + 12.0 * multiply(edge[1], b0),
    12.0 * multiply(edge[1], b1) + 6.0 * multiply(edge[2], b0), 18.0 * multiply(edge[2], b1) };
}

// Of a polynomial, by its Bernstein coefficients.
template <std::size_t Count>
Interval range(const std::array<double, Count>& coefficients)
{
  const auto [least, most] = std::minmax_element(coefficients.begin(), coefficients.end());
  return { *least, *most };
}

class Clearance
{
public:
  Clearance(bool closed, double radius) : closed_(closed), radius_(radius) {}

  bool check(const std::vector<CubicSpan>& spans)
  {
    double length = 0.0;
    for (const CubicSpan& span : spans)
    {
      length += (span.control[3].at - span.control[0].at).norm();
    }
    longest_ = length / 1000.0;
    for (std::size_t k = 0; k < spans.size(); ++k)
    {
      if (!this->addPart(spans[k], 0) || ((k > 0 || closed_) && !this->smooth(spans, k)))
      {
        return false;
      }
    }
    return this->partsAreApart();
  }

private:
  // Whether the span before goes over into this one without a corner or a crease.
  static bool smooth(const std::vector<CubicSpan>& spans, std::size_t k)
  {
    const ThickPoint before = spans[(k + spans.size() - 1) % spans.size()].slope(1.0);
    const ThickPoint after = spans[k].slope(0.0);
    return angle(before.at, after.at) < kCorner &&
      std::abs(before.radius / before.at.norm() - after.radius / after.at.norm()) < kCorner;
  }

  bool addPart(const CubicSpan& part, int depth)
  {
    std::array<Vec3, 3> edge;
    double radius = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      edge[k] = part.control[k + 1].at - part.control[k].at;
    }
    for (const ThickPoint& control : part.control)
    {
      radius = std::max(radius, radius_ + control.radius);
    }
    const double turn = angle(edge[0], edge[1]) + angle(edge[1], edge[2]);
    const Vec3 chord = part.control[3].at - part.control[0].at;
    const double length = chord.norm();
    const bool fine = turn < kLargestTurn && length <= std::max(0.4 * radius, longest_) &&
      this->envelopeIsRegular(part, edge, chord / length);
    if (!fine) // NaN, too
    {
      return depth < kMostHalvings && pieces_.size() < kMostPieces &&
        this->addPart(part.part(0.0, 0.5), depth + 1) &&
        this->addPart(part.part(0.5, 1.0), depth + 1);
    }
    const double sag = std::max((part.control[1].at - part.control[0].at - chord / 3.0).norm(),
      (part.control[3].at - part.control[2].at - chord / 3.0).norm());
    pieces_.push_back(
      { part.control[0].at, part.control[3].at, sag, radius, turned_, turned_ + turn });
    turned_ += turn;
    return true;
  }

  // The circle in which the ball at t touches the envelope moves forward all around:
  // 1 - s'^2 - r s'' - k r sqrt(1 - s'^2) > 0 of the curvature k and the derivatives of the radius
  // by the length of the curve. By bounds over the part; NaN gives false.
  bool envelopeIsRegular(const CubicSpan& part, const std::array<Vec3, 3>& edge, const Vec3& along)
  {
    using Four = std::array<double, 4>;
    const Interval forward =
      range(std::array<double, 3>{ edge[0].dot(along), edge[1].dot(along), edge[2].dot(along) });
    if (!(forward.min > 0.0))
    {
      return false;
    }
    const double longest = std::max({ edge[0].norm(), edge[1].norm(), edge[2].norm() });
    const Interval perSpeed{ 1.0 / (3.0 * longest), 1.0 / (3.0 * forward.min) };
    const auto cross = [](const Vec3& u, const Vec3& v) { return Vec3(u.cross(v)); };
    double curvature = 0.0;
    for (const Vec3& coefficient : slopeTimesBend(edge, cross))
    {
      curvature = std::max(curvature, coefficient.norm() * std::pow(perSpeed.max, 3));
    }
    const auto [r0, r1, r2, r3] = part.control;
    const Interval radius = range(
      Four{ radius_ + r0.radius, radius_ + r1.radius, radius_ + r2.radius, radius_ + r3.radius });
    if (!part.thick())
    {
      return curvature * radius.max < 1.0;
    }
    const std::array<double, 3> rise = { r1.radius - r0.radius, r2.radius - r1.radius,
      r3.radius - r2.radius };
    const Interval slope = perSpeed * (3.0 * range(rise));
    const Interval bend =
      6.0 * range(std::array<double, 2>{ rise[1] - rise[0], rise[2] - rise[1] });
    const auto dot = [](const Vec3& u, const Vec3& v) { return u.dot(v); };
    const Interval speedUp = perSpeed * range(slopeTimesBend(edge, dot));
    const Interval change = perSpeed * perSpeed * (bend - slope * speedUp);
    const double steepest = std::max(-slope.min, slope.max);
    const double flattest = std::max({ 0.0, slope.min, -slope.max });
    const bool regular = steepest < 0.98 &&
      1.0 - steepest * steepest - (radius * change).max -
          curvature * radius.max * std::sqrt(1.0 - flattest * flattest) >
        0.02;
    lean_ = regular ? std::max(lean_, std::asin(steepest)) : lean_;
    return regular;
  }

  bool partsAreApart() const
  {
    // Normals of a varying radius lean, and so do the chords.
    const double least = kPi - 2.0 * lean_;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
    {
      const Piece& p = pieces_[i];
      // The last of those that the curve reaches by turning less.
      auto j = static_cast<std::size_t>(
        std::lower_bound(pieces_.begin() + static_cast<std::ptrdiff_t>(i), pieces_.end(),
          p.turnFrom + least, [](const Piece& q, double turn) { return q.turnTo < turn; }) -
        pieces_.begin());
      for (; j < pieces_.size(); ++j)
      {
        const Piece& q = pieces_[j];
        if (closed_ && turned_ - (q.turnFrom - p.turnTo) < least)
        {
          break; // from here on they are near the other way around
        }
        if (!apart(p, q))
        {
          return false;
        }
      }
    }
    return true;
  }

  static bool apart(const Piece& p, const Piece& q)
  {
    const double needed = p.radius + q.radius + p.sag + q.sag;
    const double half = 0.5 * ((p.b - p.a).norm() + (q.b - q.a).norm());
    return 0.5 * (p.a + p.b - q.a - q.b).norm() > needed + half || segmentDistance(p, q) > needed;
  }

  bool closed_;
  double radius_;
  double longest_ = 0.0;
  double turned_ = 0.0;
  double lean_ = 0.0; // of normals out of the plane across the curve, at most
  std::vector<Piece> pieces_;
};

} // namespace

bool tubeIsClear(const std::vector<CubicSpan>& spans, bool closed, double radius)
{
  return Clearance(closed, radius).check(spans);
}

} // namespace hybridtree
