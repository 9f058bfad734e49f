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

// Curves of more spans keep what their distance needs.
constexpr std::size_t kShort = 4;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::array<const char*, 3> kKindNames = { "catmullRom", "bSpline", "polyline" };

std::vector<CubicSpan> spansOf(const SplineCurve& curve)
{
  std::vector<CubicSpan> spans;
  splineSpans(curve, spans);
  return spans;
}

// A short curve prepared for this thread, until the next.
const CurveDistance& shortCurve(const SplineCurve& curve)
{
  thread_local std::vector<CubicSpan> spans;
  thread_local CurveDistance distance;
  splineSpans(curve, spans);
  distance.assign(spans);
  return distance;
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

SplineSkeleton::SplineSkeleton(SplineCurve curve) : curve_(requireCurve(std::move(curve)))
{
  if (std::all_of(curve_.radii.begin(), curve_.radii.end(), [](double r) { return r == 0.0; }))
  {
    curve_.radii.clear();
  }
  curve_.points.shrink_to_fit();
  curve_.radii.shrink_to_fit();
  if (splineSpanCount(curve_) > kShort)
  {
    prepared_ = std::make_unique<const CurveDistance>(spansOf(curve_));
  }
}

void SplineSkeleton::offsets(
  PointBatch points, VectorBatch offset, double* radius, double reach) const
{
  (prepared_ ? *prepared_ : shortCurve(curve_)).offsets(points, offset, radius, reach);
}

void SplineSkeleton::signedDistance(PointBatch points, double* distance) const
{
  ScratchVectors scratch(points.size);
  ScratchArray radius(points.size);
  const VectorBatch offset = scratch.batch();
  this->offsets(points, offset, radius.data(), kInfinity);
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
  this->offsets(points, offset, radius.data(), reach);
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
  this->offsets(points, gradient, radius.data(), kInfinity);
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
  this->offsets({ &center.x(), &center.y(), &center.z(), 1 },
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
  return prepared_ ? prepared_->bounds() : shortCurve(curve_).bounds();
}

std::optional<TriangleMesh> SplineSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius == 0.0 && curve_.radii.empty())
  {
    return TriangleMesh(); // encloses nothing
  }
  return meshSweep(spansOf(curve_), curve_.isClosed(), radius, edgeLength);
}

SkeletonPtr SplineSkeleton::similarityImage(const Affine3& map, double scale) const
{
  SplineCurve image = curve_;
  for (Vec3& point : image.points)
  {
    point = map * point;
  }
  for (double& radius : image.radii)
  {
    radius *= scale;
  }
  return std::make_shared<SplineSkeleton>(std::move(image));
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
  describeCurve(curve_, parameters);
  return parameters;
}

SkeletonPtr SplineSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<SplineSkeleton>(curveFrom(parameters));
}

} // namespace hybridtree
