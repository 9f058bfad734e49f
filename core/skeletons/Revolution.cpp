// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Revolution.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hybridtree
{
namespace
{

RevolutionShape requireShape(RevolutionShape shape)
{
  requireFinite("Origin", shape.origin);
  shape.axis = requireDirection("Axis", shape.axis);
  shape.profile.radii.clear();
  shape.profile = requireCurve(std::move(shape.profile));
  const std::vector<Vec3>& points = shape.profile.points;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const std::string name = "of profile point " + std::to_string(k);
    requireNotNegative("The radius " + name, points[k].x());
    if (points[k].z() != 0.0)
    {
      throw InvalidParameter("The third number " + name, points[k].z(), "0");
    }
  }
  if (shape.solid && points.size() < 2)
  {
    throw InvalidParameter("The number of different profile points",
      static_cast<double>(points.size()), "2 or more for a solid");
  }
  return shape;
}

CubicSpan line(const Vec3& a, const Vec3& b)
{
  const Vec3 third = (b - a) / 3.0;
  return { { ThickPoint{ a }, ThickPoint{ a + third }, ThickPoint{ b - third }, ThickPoint{ b } } };
}

CubicSpan mirrored(CubicSpan span)
{
  for (ThickPoint& point : span.control)
  {
    point.at.x() = -point.at.x();
  }
  return span;
}

/// Of what the spans sweep around the axis.
Box3 sweptBounds(const std::vector<CubicSpan>& spans, const RevolutionShape& shape)
{
  Box3 box;
  for (CubicSpan span : spans)
  {
    const CubicSpan flat = span;
    Box3 part;
    for (int axis = 0; axis < 3; ++axis)
    {
      // A circle of radius r around the axis reaches r sqrt(1 - a_i^2) along coordinate i.
      const double a = shape.axis[axis];
      const double across = std::sqrt(std::max(0.0, 1.0 - a * a));
      for (std::size_t k = 0; k < 4; ++k)
      {
        span.control[k].at[axis] = shape.origin[axis] + flat.control[k].at.y() * a;
        span.control[k].radius = flat.control[k].at.x() * across;
      }
      const Box3 balls = span.ballBounds();
      part.min()[axis] = std::min(balls.min()[axis], balls.max()[axis]);
      part.max()[axis] = std::max(balls.min()[axis], balls.max()[axis]);
    }
    box.extend(part);
  }
  return box;
}

} // namespace

std::vector<CubicSpan> drawnProfile(const RevolutionShape& shape)
{
  std::vector<CubicSpan> spans;
  splineSpans(shape.profile, spans);
  if (shape.solid && !shape.profile.isClosed())
  {
    const Vec3 first = spans.front().control[0].at;
    const Vec3 last = spans.back().control[3].at;
    spans.insert(spans.begin(), line(Vec3(0.0, first.y(), 0.0), first));
    spans.push_back(line(last, Vec3(0.0, last.y(), 0.0)));
  }
  const std::size_t count = spans.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    if (spans[k].bounds().min().x() < 0.0)
    {
      spans.push_back(mirrored(spans[k]));
    }
  }
  return spans;
}

RevolutionSkeleton::RevolutionSkeleton(RevolutionShape shape)
  : shape_(requireShape(std::move(shape))), side_(anyAcross(shape_.axis))
{
  const std::vector<CubicSpan> spans = drawnProfile(shape_);
  distance_.assign(spans);
  bounds_ = sweptBounds(spans, shape_);
  if (shape_.solid)
  {
    region_ = PlanarRegion(spans);
  }
}

void RevolutionSkeleton::offsets(
  PointBatch points, VectorBatch planar, double* signedDistance) const
{
  ScratchVectors local(points.size);
  const VectorBatch half = local.batch();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 p = points[k] - shape_.origin;
    const double height = shape_.axis.dot(p);
    half.set(k, Vec3((p - height * shape_.axis).norm(), height, 0.0));
  }
  distance_.offsets(local.points(), planar, nullptr, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double length = planar[k].norm();
    signedDistance[k] = shape_.solid && region_.contains(half.x[k], half.y[k]) ? -length : length;
  }
}

void RevolutionSkeleton::signedDistance(PointBatch points, double* distance) const
{
  ScratchVectors planar(points.size);
  this->offsets(points, planar.batch(), distance);
}

void RevolutionSkeleton::distance(PointBatch points, double* distance) const
{
  this->signedDistance(points, distance);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] = std::max(0.0, distance[k]);
  }
}

void RevolutionSkeleton::distanceAndGradient(
  PointBatch points, double* distance, VectorBatch gradient) const
{
  this->offsets(points, gradient, distance);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (!(distance[k] > 0.0))
    {
      distance[k] = 0.0;
      gradient.set(k, Vec3::Zero());
      continue;
    }
    const Vec3 p = points[k] - shape_.origin;
    const Vec3 radial = p - shape_.axis.dot(p) * shape_.axis;
    const double length = radial.norm();
    const Vec3 outward = length > 1e-15 * p.norm() ? Vec3(radial / length) : side_;
    const Vec3 planar = gradient[k];
    gradient.set(k, ((planar.x() * outward + planar.y() * shape_.axis) / distance[k]).normalized());
  }
}

Interval RevolutionSkeleton::distanceRange(const Box3& box) const
{
  const Vec3 center = box.center();
  const PointBatch one{ &center.x(), &center.y(), &center.z(), 1 };
  double atCenter;
  Vec3 gradient;
  this->signedDistance(one, &atCenter);
  const double reach = 0.5 * box.sizes().norm();
  double most = std::max(0.0, atCenter + reach);
  if (atCenter > 0.0)
  {
    double distance;
    this->distanceAndGradient(one, &distance, { &gradient.x(), &gradient.y(), &gradient.z() });
    // Not farther than from the point that is nearest to the centre: a convex distance.
    const Vec3 nearest = center - distance * gradient;
    most = std::min(
      most, (box.max() - nearest).cwiseAbs().cwiseMax((box.min() - nearest).cwiseAbs()).norm());
  }
  return widenedByRounding({ std::max(0.0, atCenter - reach), most }, box, bounds_);
}

std::optional<TriangleMesh> RevolutionSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius == 0.0 && !shape_.solid)
  {
    return TriangleMesh(); // encloses nothing
  }
  return meshRevolution(shape_, side_, radius, edgeLength, distance_);
}

SkeletonPtr RevolutionSkeleton::similarityImage(const Affine3& map, double scale) const
{
  RevolutionShape image = shape_;
  image.origin = map * shape_.origin;
  image.axis = map.linear() * shape_.axis;
  for (Vec3& point : image.profile.points)
  {
    point *= scale;
  }
  return std::make_shared<RevolutionSkeleton>(std::move(image));
}

Parameters RevolutionSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("origin", shape_.origin);
  parameters.set("axis", shape_.axis);
  describeCurve(shape_.profile, parameters);
  parameters.set("solid", shape_.solid);
  return parameters;
}

SkeletonPtr RevolutionSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<RevolutionSkeleton>(RevolutionShape{ parameters.getVec3("origin"),
    parameters.getVec3("axis"), curveFrom(parameters), parameters.getBool("solid") });
}

} // namespace hybridtree
