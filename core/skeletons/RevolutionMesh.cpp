// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Revolution.h"

#include "core/base/Scratch.h"
#include "core/skeletons/RevolvedMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
// Directions that differ by less are the same but for rounding.
constexpr double kCorner = 1e-7;
constexpr int kSamples = 64; // per span

Vec2 planar(const Vec3& v)
{
  return { v.x(), v.y() };
}

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

double angleOf(const Vec2& normal)
{
  return std::atan2(normal.y(), normal.x());
}

CubicSpan reversed(const CubicSpan& span)
{
  return { { span.control[3], span.control[2], span.control[1], span.control[0] } };
}

bool straight(const CubicSpan& span)
{
  const Vec3 chord = span.control[3].at - span.control[0].at;
  const double slack = 1e-12 * chord.norm();
  return (span.control[1].at - span.control[0].at - chord / 3.0).norm() <= slack &&
    (span.control[3].at - span.control[2].at - chord / 3.0).norm() <= slack;
}

// One span of the walk around the shape, the outside on its right, and the part of it whose offset
// belongs to the surface.
struct Step
{
  CubicSpan span;
  bool line;
  double from = 0.0;
  double to = 1.0;

  Vec2 normal(double t) const
  {
    const Vec3 slope = span.slope(t).at;
    return Vec2(slope.y(), -slope.x()).normalized();
  }
  MeridianPoint offset(double t, double radius) const
  {
    const Vec2 n = this->normal(t);
    return { planar(span.at(t).at) + radius * n, n };
  }
};

class OffsetProfile
{
public:
  OffsetProfile(const RevolutionShape& shape, double radius) : shape_(shape), radius_(radius) {}

  // False when there is no such walk.
  bool walk()
  {
    std::vector<CubicSpan> spans = drawnProfile(shape_);
    const bool closed = shape_.profile.isClosed();
    for (const CubicSpan& span : spans)
    {
      if (span.bounds().min().x() < -1e-12 * span.bounds().max().norm())
      {
        return false;
      }
    }
    const bool startsOnAxis = spans.front().control[0].at.x() == 0.0;
    const bool endsOnAxis = spans.back().control[3].at.x() == 0.0;
    loop_ = shape_.solid ? closed : !(startsOnAxis || endsOnAxis);
    if (shape_.solid)
    {
      return this->addAround(spans);
    }
    if (closed || (startsOnAxis && endsOnAxis))
    {
      return false; // an outer and an inner surface
    }
    if (endsOnAxis)
    {
      reverse(spans);
    }
    for (const CubicSpan& span : spans)
    {
      this->add(span);
    }
    reverse(spans);
    for (const CubicSpan& span : spans)
    {
      this->add(span);
    }
    return !steps_.empty();
  }

  // The corners between steps: arcs, or steps cut short. False where neither will do.
  bool trim()
  {
    const std::size_t count = steps_.size();
    for (std::size_t k = loop_ ? 0 : 1; k < count; ++k)
    {
      Step& before = steps_[(k + count - 1) % count];
      Step& after = steps_[k];
      const Vec2 a = before.normal(1.0);
      const Vec2 b = after.normal(0.0);
      if (cross(a, b) > -kCorner || radius_ == 0.0)
      {
        continue;
      }
      if (!before.line || !after.line)
      {
        return false;
      }
      const double cut = radius_ * std::tan(0.5 * std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
      before.to = 1.0 - cut / length(before);
      after.from = cut / length(after);
    }
    if (!loop_ && radius_ > 0.0)
    {
      // A dent at the axis: the offset begins or ends where it meets the axis.
      this->startAtAxis(steps_.front(), steps_.front().from, steps_.front().to);
      this->startAtAxis(steps_.back(), steps_.back().to, steps_.back().from);
    }
    return std::all_of(
      steps_.begin(), steps_.end(), [](const Step& step) { return step.from < step.to; });
  }

  Meridian meridian() const
  {
    Meridian meridian(loop_ ? Meridian::Kind::Loop : Meridian::Kind::AxisToAxis);
    const std::size_t count = steps_.size();
    if (!loop_)
    {
      this->addArc(planar(steps_.front().span.control[0].at), Vec2(0.0, -1.0),
        steps_.front().normal(0.0), meridian);
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      const Step& step = steps_[k];
      this->addStep(step, meridian);
      const bool last = k + 1 == count;
      const Vec2 corner = planar(step.span.control[3].at);
      if (last && !loop_)
      {
        this->addArc(corner, step.normal(1.0), Vec2(0.0, 1.0), meridian);
      }
      else
      {
        this->addArc(corner, step.normal(1.0), steps_[(k + 1) % count].normal(0.0), meridian);
      }
    }
    return meridian;
  }

  bool loop() const { return loop_; }

private:
  static void reverse(std::vector<CubicSpan>& spans)
  {
    std::reverse(spans.begin(), spans.end());
    for (CubicSpan& span : spans)
    {
      span = reversed(span);
    }
  }

  // Moves `end` of a step towards `other` until the offset is not beyond the axis.
  void startAtAxis(const Step& step, double& end, double other) const
  {
    const auto beyond = [&](double t) { return step.offset(t, radius_).position.x() < 0.0; };
    if (step.normal(end).x() > -kCorner || !beyond(end))
    {
      return;
    }
    double low = end;
    double high = other;
    for (int round = 0; round < 60; ++round)
    {
      const double middle = 0.5 * (low + high);
      (beyond(middle) ? low : high) = middle;
    }
    end = high;
  }

  static double length(const Step& step)
  {
    return (step.span.control[3].at - step.span.control[0].at).norm();
  }

  void add(const CubicSpan& span)
  {
    if (span.control[0].at != span.control[3].at)
    {
      steps_.push_back({ span, straight(span) });
    }
  }

  bool addAround(std::vector<CubicSpan>& spans)
  {
    double area = 0.0;
    for (const CubicSpan& span : spans)
    {
      for (int k = 0; k < kSamples; ++k)
      {
        area += cross(
          planar(span.at(double(k) / kSamples).at), planar(span.at(double(k + 1) / kSamples).at));
      }
    }
    const Vec2 start = planar(spans.front().control[0].at);
    const Vec2 end = planar(spans.back().control[3].at);
    area += cross(end, start);
    if (area < 0.0)
    {
      reverse(spans);
    }
    for (const CubicSpan& span : spans)
    {
      this->add(span);
    }
    return area != 0.0 && !steps_.empty();
  }

  // Around a corner from one normal to the next, where it stands out.
  void addArc(const Vec2& corner, const Vec2& from, const Vec2& to, Meridian& meridian) const
  {
    const double turn = std::atan2(cross(from, to), from.dot(to));
    const bool back = from.dot(to) < 0.0 && std::abs(cross(from, to)) < kCorner;
    if (radius_ > 0.0 && (back || turn > kCorner))
    {
      const double angle = angleOf(from);
      meridian.addArc(corner, radius_, angle, angle + (back ? kPi : turn));
    }
  }

  void addStep(const Step& step, Meridian& meridian) const
  {
    if (step.line)
    {
      meridian.addLine(
        step.offset(step.from, radius_).position, step.offset(step.to, radius_).position);
      return;
    }
    std::vector<double> along{ 0.0 };
    const auto at = [=](double share)
    { return step.from + share / kSamples * (step.to - step.from); };
    for (int k = 1; k <= kSamples; ++k)
    {
      along.push_back(along.back() +
        (step.offset(at(k), radius_).position - step.offset(at(k - 1), radius_).position).norm());
    }
    meridian.addCurve(along.back(),
      [step, at, along, radius = radius_](double s)
      {
        const auto next = std::upper_bound(along.begin(), along.end(), s);
        const auto k = static_cast<std::size_t>(
          std::clamp<std::ptrdiff_t>(next - along.begin() - 1, 0, kSamples - 1));
        const double share = std::clamp((s - along[k]) / (along[k + 1] - along[k]), 0.0, 1.0);
        return step.offset(at(static_cast<double>(k) + share), radius);
      });
  }

  const RevolutionShape& shape_;
  double radius_;
  bool loop_ = false;
  std::vector<Step> steps_;
};

std::vector<Vec2> samplesOf(const Meridian& meridian)
{
  std::vector<Vec2> samples;
  for (const Meridian::Piece& piece : meridian.pieces())
  {
    for (int k = 0; k < kSamples; ++k)
    {
      samples.push_back(piece.at(piece.length * (k + 0.5) / kSamples).position);
    }
  }
  return samples;
}

// Whether each point is as far from the profile as it should be.
bool keepsDistance(const std::vector<Vec2>& points, const CurveDistance& distance, double radius)
{
  const double slack = 1e-9 * (distance.bounds().diagonal().norm() + radius);
  ScratchVectors places(points.size());
  ScratchVectors offsets(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    places.batch().set(k, Vec3(points[k].x(), points[k].y(), 0.0));
  }
  distance.offsets(
    places.points(), offsets.batch(), nullptr, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (!(offsets.batch()[k].norm() > radius - slack && points[k].x() > -slack))
    {
      return false;
    }
  }
  return true;
}

std::vector<Vec2> placesOf(const std::vector<Ring>& rings)
{
  std::vector<Vec2> places;
  for (const Ring& ring : rings)
  {
    places.push_back(ring.place.position);
  }
  return places;
}

bool segmentsCross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
  const double u = cross(b - a, c - a) * cross(b - a, d - a);
  const double v = cross(d - c, a - c) * cross(d - c, b - c);
  return u < 0.0 && v < 0.0;
}

// Whether the chain through the samples crosses itself.
bool isSimple(const std::vector<Vec2>& samples, bool loop)
{
  const std::size_t count = loop ? samples.size() : samples.size() - 1;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec2& a = samples[i];
    const Vec2& b = samples[(i + 1) % samples.size()];
    const Vec2 low = a.cwiseMin(b);
    const Vec2 high = a.cwiseMax(b);
    for (std::size_t j = i + 2; j < count; ++j)
    {
      const Vec2& c = samples[j];
      const Vec2& d = samples[(j + 1) % samples.size()];
      if ((c.cwiseMin(d).array() <= high.array()).all() &&
        (low.array() <= c.cwiseMax(d).array()).all() && segmentsCross(a, b, c, d))
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace

std::optional<TriangleMesh> meshRevolution(const RevolutionShape& shape, const Vec3& side,
  double radius, double edgeLength, const CurveDistance& distance)
{
  OffsetProfile profile(shape, radius);
  if (!profile.walk() || !profile.trim())
  {
    return std::nullopt;
  }
  const Meridian meridian = profile.meridian();
  const std::vector<Vec2> samples = samplesOf(meridian);
  if (samples.empty() || !keepsDistance(samples, distance, radius) ||
    !isSimple(samples, profile.loop()))
  {
    return std::nullopt;
  }
  const Meridian::Piece& last = meridian.pieces().back();
  const double offAxis = std::max(std::abs(meridian.pieces().front().at(0.0).position.x()),
    std::abs(last.at(last.length).position.x()));
  const bool placed = profile.loop()
    ? std::all_of(samples.begin(), samples.end(), [](const Vec2& p) { return p.x() > 0.0; })
    : offAxis <= 1e-9 * meridian.length();
  if (!placed)
  {
    return std::nullopt;
  }
  // Between two samples the offset may still be inside of itself, which shows where a ring is
  // there.
  const std::vector<Ring> rings = revolvedRings(meridian, edgeLength);
  if (!keepsDistance(placesOf(rings), distance, radius))
  {
    return std::nullopt;
  }
  return meshRings(rings, meridian.loop(), { shape.origin, shape.axis, side });
}

} // namespace hybridtree
