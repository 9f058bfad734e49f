// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Spline.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/geometry/SkeletonKernels.h"
#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/SweepMesh.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace hybridtree
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::array<const char*, 3> kKindNames = { "catmullRom", "bSpline", "polyline" };

std::vector<CubicSpan> spansOf(const SplineCurve& curve)
{
  std::vector<CubicSpan> spans;
  splineSpans(curve, spans);
  return spans;
}

// One that keeps what its distance needs.
class LongSpline final : public SplineSkeleton
{
public:
  explicit LongSpline(SplineCurve curve) : curve_(std::move(curve)), prepared_(spansOf(curve_))
  {
    curve_.points.shrink_to_fit();
    curve_.radii.shrink_to_fit();
  }

private:
  void read(SplineCurve& curve) const override { curve = curve_; }
  const CurveDistance& prepared() const override { return prepared_; }

  SplineCurve curve_;
  CurveDistance prepared_;
};

// One that prepares them anew, unless this thread has just done so for the same numbers.
template <std::size_t Numbers>
class ShortSpline final : public SplineSkeleton
{
public:
  explicit ShortSpline(const SplineCurve& curve)
    : points_(static_cast<std::uint8_t>(curve.points.size()))
    , thick_(!curve.radii.empty())
    , closed_(curve.closed)
    , kind_(curve.kind)
  {
    double* end = numbers_.data();
    for (const Vec3& point : curve.points)
    {
      end = std::copy(point.begin(), point.end(), end);
    }
    end = std::copy(curve.radii.begin(), curve.radii.end(), end);
    std::fill(end, numbers_.data() + Numbers, 0.0);
  }

private:
  void read(SplineCurve& curve) const override
  {
    curve.points.resize(points_);
    const double* next = numbers_.data();
    for (Vec3& point : curve.points)
    {
      point = Vec3(next[0], next[1], next[2]);
      next += 3;
    }
    curve.radii.assign(next, next + (thick_ ? points_ : 0));
    curve.kind = kind_;
    curve.closed = closed_;
  }

  const CurveDistance& prepared() const override
  {
    thread_local SplineCurve curve;
    thread_local std::vector<CubicSpan> spans;
    thread_local CurveDistance distance;
    if (!this->is(curve))
    {
      this->read(curve);
      splineSpans(curve, spans);
      distance.assign(spans);
    }
    return distance;
  }

  bool is(const SplineCurve& curve) const
  {
    const double* next = numbers_.data();
    bool same = curve.points.size() == points_ && curve.radii.empty() == !thick_ &&
      curve.kind == kind_ && curve.closed == closed_;
    for (std::size_t k = 0; same && k < points_; ++k, next += 3)
    {
      same = curve.points[k] == Vec3(next[0], next[1], next[2]);
    }
    return same && std::equal(curve.radii.begin(), curve.radii.end(), next);
  }

  std::uint8_t points_;
  bool thick_;
  bool closed_;
  SplineKind kind_;
  std::array<double, Numbers> numbers_; // of the points, then the radii
};

constexpr std::size_t kMostShort = 21;

// The smallest kind that has room.
template <std::size_t Numbers>
SplinePtr shortSpline(const SplineCurve& curve, std::size_t needed)
{
  if constexpr (Numbers < kMostShort)
  {
    if (needed > Numbers)
    {
      return shortSpline<Numbers + 4>(curve, needed);
    }
  }
  return std::make_shared<const ShortSpline<Numbers>>(curve);
}

} // namespace

SplineCurve requireCurve(SplineCurve curve)
{
  if (curve.points.empty())
  {
    throw InvalidParameter("Points", "empty", "one point or more");
  }
  for (std::size_t k = 0; k < curve.points.size(); ++k)
  {
    requireFinite("Point " + std::to_string(k), curve.points[k]);
  }
  if (!curve.radii.empty() && curve.radii.size() != curve.points.size())
  {
    throw InvalidParameter("The number of radii", static_cast<double>(curve.radii.size()),
      "that of the points, " + std::to_string(curve.points.size()));
  }
  for (std::size_t k = 0; k < curve.radii.size(); ++k)
  {
    requireFinite("The radius of point " + std::to_string(k), curve.radii[k]);
  }
  if (!curve.radii.empty() && !(*std::max_element(curve.radii.begin(), curve.radii.end()) >= 0.0))
  {
    throw InvalidParameter(
      "The largest radius", *std::max_element(curve.radii.begin(), curve.radii.end()), "0 or more");
  }
  return withoutRepeats(std::move(curve));
}

SplinePtr makeSpline(SplineCurve curve)
{
  curve = requireCurve(std::move(curve));
  if (std::all_of(curve.radii.begin(), curve.radii.end(), [](double r) { return r == 0.0; }))
  {
    curve.radii.clear();
  }
  const std::size_t numbers = 3 * curve.points.size() + curve.radii.size();
  return numbers > kMostShort ? std::make_shared<const LongSpline>(std::move(curve))
                              : shortSpline<9>(curve, numbers);
}

SplineCurve SplineSkeleton::curve() const
{
  SplineCurve curve;
  this->read(curve);
  return curve;
}

void SplineSkeleton::signedDistance(PointBatch points, double* distance) const
{
  ScratchVectors scratch(points.size);
  ScratchArray radius(points.size);
  const VectorBatch offset = scratch.batch();
  this->prepared().offsets(points, offset, radius.data(), kInfinity);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] = offset[k].norm() - radius[k];
  }
}

void SplineSkeleton::reachedDistance(PointBatch points, double* distance, double reach) const
{
  ScratchVectors scratch(points.size);
  ScratchArray radius(points.size);
  const VectorBatch offset = scratch.batch();
  this->prepared().offsets(points, offset, radius.data(), reach);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] = std::max(0.0, offset[k].norm() - radius[k]);
  }
}

void SplineSkeleton::distance(PointBatch points, double* distance) const
{
  this->reachedDistance(points, distance, kInfinity);
}

void SplineSkeleton::distanceAndGradient(
  PointBatch points, double* distance, VectorBatch gradient) const
{
  ScratchArray radius(points.size);
  this->prepared().offsets(points, gradient, radius.data(), kInfinity);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 offset = gradient[k];
    const double length = offset.norm();
    distance[k] = std::max(0.0, length - radius[k]);
    gradient.set(k, distance[k] > 0.0 ? Vec3(offset / length) : Vec3(Vec3::Zero()));
  }
}

void SplineSkeleton::addFalloff(PointBatch points, const Falloff& falloff, double* sum) const
{
  ScratchArray value(points.size);
  this->reachedDistance(points, value.data(), 1.0 / std::sqrt(falloff.inverseSquaredRadius));
  evaluateFalloff(falloff, value.data(), value.data(), points.size);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += value[k];
  }
}

Interval SplineSkeleton::distanceRange(const Box3& box) const
{
  const Vec3 center = box.center();
  Vec3 offset;
  double radius;
  this->prepared().offsets({ &center.x(), &center.y(), &center.z(), 1 },
    { &offset.x(), &offset.y(), &offset.z() }, &radius, kInfinity);
  // Not farther than from the ball that is nearest to the centre: a convex distance.
  const Vec3 nearest = center - offset;
  const Vec3 far = (box.max() - nearest).cwiseAbs().cwiseMax((box.min() - nearest).cwiseAbs());
  const double reach = 0.5 * box.sizes().norm();
  const double atCenter = offset.norm() - radius;
  return widenedByRounding({ std::max(0.0, atCenter - reach),
                             std::max(0.0, std::min(far.norm() - radius, atCenter + reach)) },
    box, this->bounds());
}

Box3 SplineSkeleton::bounds() const
{
  return this->prepared().bounds();
}

std::optional<TriangleMesh> SplineSkeleton::offsetMesh(double radius, double edgeLength) const
{
  const SplineCurve curve = this->curve();
  if (radius == 0.0 && curve.radii.empty())
  {
    return TriangleMesh(); // encloses nothing
  }
  return meshSweep(spansOf(curve), curve.isClosed(), radius, edgeLength);
}

SkeletonPtr SplineSkeleton::similarityImage(const Affine3& map, double scale) const
{
  SplineCurve image = this->curve();
  for (Vec3& point : image.points)
  {
    point = map * point;
  }
  for (double& radius : image.radii)
  {
    radius *= scale;
  }
  return makeSpline(std::move(image));
}

void describeCurve(const SplineCurve& curve, Parameters& parameters)
{
  std::vector<double> numbers;
  for (const Vec3& point : curve.points)
  {
    numbers.insert(numbers.end(), point.begin(), point.end());
  }
  parameters.set("points", std::move(numbers));
  parameters.set("spline", kKindNames[static_cast<std::size_t>(curve.kind)]);
  parameters.set("closed", curve.closed);
  if (!curve.radii.empty())
  {
    parameters.set("radii", curve.radii);
  }
}

SplineCurve curveFrom(const Parameters& parameters)
{
  SplineCurve curve;
  const std::vector<double> numbers = parameters.getDoubles("points");
  if (numbers.size() % 3 != 0)
  {
    throw InvalidText("Parameter \"points\" has " + std::to_string(numbers.size()) +
      " numbers; it must have three for each point.");
  }
  for (std::size_t k = 0; k < numbers.size(); k += 3)
  {
    curve.points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  }
  const std::string kind = parameters.getString("spline");
  const auto name = std::find(kKindNames.begin(), kKindNames.end(), kind);
  if (name == kKindNames.end())
  {
    throw InvalidText(
      "Parameter \"spline\" is \"" + kind + "\"; it must be catmullRom, bSpline or polyline.");
  }
  curve.kind = static_cast<SplineKind>(name - kKindNames.begin());
  curve.closed = parameters.getBool("closed");
  if (parameters.has("radii"))
  {
    curve.radii = parameters.getDoubles("radii");
  }
  return curve;
}

Parameters SplineSkeleton::parameters() const
{
  Parameters parameters;
  describeCurve(this->curve(), parameters);
  return parameters;
}

SkeletonPtr SplineSkeleton::fromParameters(const Parameters& parameters)
{
  return makeSpline(curveFrom(parameters));
}

} // namespace hybridtree
