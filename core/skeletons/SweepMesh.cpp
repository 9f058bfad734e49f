// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/SweepMesh.h"

#include "core/geometry/CurveDistance.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/TubeClearance.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kSamples = 32; // per span

// Largest turn of the curve from ring to ring, in radians.
constexpr double kRingTurn = 0.5;

// The tube, and beside it the same drawn straight: points (radial, y), y along the curve.
class Tube
{
public:
  Tube(const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength)
    : spans_(spans), closed_(closed), radius_(radius)
  {
    this->sample(edgeLength);
    this->transport();
  }

  // Whether y grows along the tube: it does not where balls swallow their neighbours.
  bool monotone() const
  {
    for (std::size_t k = 1; k < y_.size(); ++k)
    {
      if (!(y_[k] > y_[k - 1]))
      {
        return false;
      }
    }
    return true;
  }

  double from() const { return y_.front(); }
  double to() const { return y_.back(); }
  double curveLength() const { return along_.back(); }
  double largestRadius() const { return largest_; }

  // In the straight drawing, at a y between from() and to().
  MeridianPoint place(double y) const
  {
    const double at = this->parameter(y);
    const double lean = this->lean(at);
    const double across = std::sqrt(1.0 - lean * lean);
    return { Vec2(this->radiusAt(at) * across, y), Vec2(across, lean) };
  }

  // Of the ball at the start or end: where its center is drawn, its radius, and the angle over the
  // plane across the curve at which the round end begins.
  struct End
  {
    double center;
    double radius;
    double angle;
  };
  End end(bool last) const
  {
    const double at = last ? static_cast<double>(spans_.size()) : 0.0;
    return { last ? along_.back() : 0.0, this->radiusAt(at), std::asin(this->lean(at)) };
  }

  // From the straight drawing to where it belongs, with the normal there.
  void bend(Vec3& point, Vec3& normal) const
  {
    const double y = point.z();
    if (!closed_ && (y <= from() || y >= to()))
    {
      const bool last = y >= to();
      const double at = last ? static_cast<double>(spans_.size()) : 0.0;
      const Mat3 frame = this->frame(at);
      const double center = last ? along_.back() : 0.0;
      const Vec3 local(point.x(), point.y(), y - center);
      // Outside of the ball there is nothing: this is its surface.
      const Vec3 direction = local.norm() > 0.0 ? Vec3(local.normalized()) : Vec3(normal);
      normal = (frame * direction).normalized();
      point = this->spanAt(at).at + this->radiusAt(at) * normal;
      return;
    }
    const double at = this->parameter(y);
    const double lean = this->lean(at);
    const double across = std::sqrt(1.0 - lean * lean);
    const Vec2 turn = Vec2(point.x(), point.y()).normalized();
    normal = (this->frame(at) * Vec3(across * turn.x(), across * turn.y(), lean)).normalized();
    point = this->spanAt(at).at + this->radiusAt(at) * normal;
  }

private:
  // `at` counts spans: 2.5 is the middle of the third.
  std::pair<const CubicSpan&, double> locate(double at) const
  {
    const auto index = std::min(static_cast<std::size_t>(std::max(at, 0.0)), spans_.size() - 1);
    return { spans_[index], std::clamp(at - static_cast<double>(index), 0.0, 1.0) };
  }
  ThickPoint spanAt(double at) const
  {
    const auto [span, t] = this->locate(at);
    return span.at(t);
  }
  double radiusAt(double at) const { return radius_ + this->spanAt(at).radius; }
  // Component of the surface's normal along the curve.
  double lean(double at) const
  {
    const auto [span, t] = this->locate(at);
    const ThickPoint slope = span.slope(t);
    return -slope.radius / slope.at.norm();
  }
  Vec3 tangent(double at) const
  {
    const auto [span, t] = this->locate(at);
    return span.slope(t).at.normalized();
  }

  void sample(double edgeLength)
  {
    const std::size_t count = spans_.size() * kSamples + 1;
    double before = 0.0;
    for (std::size_t k = 0; k < count; ++k)
    {
      const double at = static_cast<double>(k) / kSamples;
      const auto [span, t] = this->locate(at);
      const Vec3 first = span.slope(t).at;
      const double speed = first.norm();
      const double curvature = first.cross(span.bend(t).at).norm() / (speed * speed * speed);
      const double r = this->radiusAt(at);
      largest_ = std::max(largest_, r);
      const double here = speed * std::max(1.0 + curvature * r, curvature * edgeLength / kRingTurn);
      along_.push_back(k == 0 ? 0.0 : along_.back() + 0.5 * (before + here) / kSamples);
      y_.push_back(along_.back() + r * this->lean(at));
      before = here;
    }
  }

  void transport()
  {
    side_.push_back(anyAcross(this->tangent(0.0)));
    for (std::size_t k = 1; k < y_.size(); ++k)
    {
      side_.push_back(this->transported(k - 1, static_cast<double>(k) / kSamples));
    }
    if (closed_)
    {
      // Angle from the first side to the one that arrives.
      const Vec3 axis = this->tangent(0.0);
      twist_ =
        std::atan2(side_.front().cross(side_.back()).dot(axis), side_.front().dot(side_.back()));
    }
  }

  // The side at sample k, carried on to `at` by two reflections.
  Vec3 transported(std::size_t k, double at) const
  {
    const double from = static_cast<double>(k) / kSamples;
    const Vec3 end = this->tangent(at);
    Vec3 side = side_[k];
    const Vec3 step = this->spanAt(at).at - this->spanAt(from).at;
    if (step.squaredNorm() > 0.0)
    {
      const Vec3 along = this->tangent(from);
      const Vec3 mirrored = along - 2.0 / step.squaredNorm() * step.dot(along) * step;
      side -= 2.0 / step.squaredNorm() * step.dot(side) * step;
      const Vec3 rest = end - mirrored;
      if (rest.squaredNorm() > 0.0)
      {
        side -= 2.0 / rest.squaredNorm() * rest.dot(side) * rest;
      }
    }
    return (side - end.dot(side) * end).normalized();
  }

  // Columns: side, across, tangent.
  Mat3 frame(double at) const
  {
    const auto k = std::min(static_cast<std::size_t>(at * kSamples), y_.size() - 1);
    Mat3 frame;
    frame.col(2) = this->tangent(at);
    const Vec3 side = this->transported(k, at);
    const Vec3 across = frame.col(2).cross(side);
    const double turn = -twist_ * at / static_cast<double>(spans_.size());
    frame.col(0) = std::cos(turn) * side + std::sin(turn) * across;
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
  }

  double parameter(double y) const
  {
    const auto next = std::upper_bound(y_.begin(), y_.end(), y);
    const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      next - y_.begin() - 1, 0, static_cast<std::ptrdiff_t>(y_.size()) - 2));
    const double share = std::clamp((y - y_[k]) / (y_[k + 1] - y_[k]), 0.0, 1.0);
    return (static_cast<double>(k) + share) / kSamples;
  }

  const std::vector<CubicSpan>& spans_;
  bool closed_;
  double radius_;
  double largest_ = 0.0;
  double twist_ = 0.0;
  std::vector<double> along_; // outer length of the curve at each sample
  std::vector<double> y_;     // of the circle that the ball there gives the surface
  std::vector<Vec3> side_;
};

TriangleMesh straightMesh(const Tube& tube, double edgeLength)
{
  Meridian meridian(Meridian::Kind::AxisToAxis);
  const Tube::End first = tube.end(false);
  const Tube::End last = tube.end(true);
  meridian.addArc(Vec2(0.0, first.center), first.radius, -0.5 * kPi, first.angle);
  meridian.addCurve(
    tube.to() - tube.from(), [&tube](double s) { return tube.place(tube.from() + s); });
  meridian.addArc(Vec2(0.0, last.center), last.radius, last.angle, 0.5 * kPi);
  return meshRevolved(meridian, {}, edgeLength);
}

TriangleMesh straightRings(const Tube& tube, double edgeLength)
{
  const double length = tube.to() - tube.from();
  const int count =
    std::max(6, 2 * static_cast<int>(std::ceil(kPi * tube.largestRadius() / edgeLength)));
  const double row = std::sqrt(0.75) *
    std::min(edgeLength, 2.0 * tube.largestRadius() * std::sin(kPi / count) * 2.0);
  const int rows = std::max(6, 2 * static_cast<int>(std::ceil(0.5 * length / row)));
  std::vector<Ring> rings;
  for (int k = 0; k < rows; ++k)
  {
    rings.push_back({ tube.place(tube.from() + length * k / rows), count, k % 2 });
  }
  return meshRings(rings, true, {});
}

double longestEdge(const TriangleMesh& mesh)
{
  double squared = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    for (int side = 0; side < 3; ++side)
    {
      squared =
        std::max(squared, (mesh.points[t[side]] - mesh.points[t[(side + 1) % 3]]).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

// Whether every point is as far from the curve as it should be: none inside another part.
bool pointsAreOnTheSurface(
  const TriangleMesh& mesh, const std::vector<CubicSpan>& spans, double radius)
{
  const CurveDistance distance(spans);
  const double tolerance = 1e-9 * (distance.bounds().diagonal().norm() + radius);
  return std::all_of(mesh.points.begin(), mesh.points.end(),
    [&](const Vec3& p)
    {
      Vec3 offset;
      double own;
      distance.offsets({ &p.x(), &p.y(), &p.z(), 1 }, { &offset.x(), &offset.y(), &offset.z() },
        &own, std::numeric_limits<double>::infinity());
      return offset.norm() - own > radius - tolerance;
    });
}

std::optional<TriangleMesh> ball(const CubicSpan& span, double radius, double edgeLength)
{
  return meshRoundedBox({ span.control[0].at, Mat3::Identity(), Vec3::Zero() },
    radius + span.control[0].radius, edgeLength);
}

} // namespace

std::optional<TriangleMesh> meshSweep(
  const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength)
{
  const CubicSpan& first = spans.front();
  if (spans.size() == 1 &&
    std::all_of(first.control.begin(), first.control.end(),
      [&](const ThickPoint& p) { return p.at == first.control[0].at; }))
  {
    return ball(first, radius, edgeLength);
  }
  const bool vanishes = std::any_of(spans.begin(), spans.end(),
    [&](const CubicSpan& span)
    {
      return std::any_of(span.control.begin(), span.control.end(),
        [&](const ThickPoint& p) { return radius + p.radius < 0.0; });
    });
  if (vanishes || !tubeIsClear(spans, closed, radius))
  {
    return std::nullopt;
  }
  const bool thick =
    std::any_of(spans.begin(), spans.end(), [](const CubicSpan& span) { return span.thick(); });
  double length = edgeLength;
  for (int round = 0; round < 20; ++round)
  {
    const Tube tube(spans, closed, radius, length);
    if (!tube.monotone())
    {
      return std::nullopt;
    }
    requireModestCount(2.0 * kPi * tube.largestRadius() *
        (tube.curveLength() + 2.0 * tube.largestRadius()) / (0.3 * length * length),
      edgeLength);
    TriangleMesh mesh = closed ? straightRings(tube, length) : straightMesh(tube, length);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
    {
      tube.bend(mesh.points[k], mesh.normals[k]);
    }
    const double longest = longestEdge(mesh);
    if (longest <= edgeLength)
    {
      return thick && !pointsAreOnTheSurface(mesh, spans, radius)
        ? std::nullopt
        : std::optional<TriangleMesh>(std::move(mesh));
    }
    length *= std::min(0.99, edgeLength / longest);
  }
  return std::nullopt;
}

} // namespace hybridtree
