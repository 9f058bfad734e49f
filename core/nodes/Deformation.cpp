// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Deformation.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

/// Replaces points by what a member of a warp makes of them.
void apply(const SpaceWarp& warp, void (SpaceWarp::*move)(PointBatch, VectorBatch) const,
  std::vector<Vec3>& points)
{
  ScratchVectors batch(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    batch.batch().set(k, points[k]);
  }
  (warp.*move)(batch.points(), batch.batch());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    points[k] = batch.batch()[k];
  }
}

/// How long a linear map makes the unit vectors of a plane, at most and at least, by the images of
/// two at right angles.
std::pair<double, double> stretches(const Vec3& a, const Vec3& b)
{
  const double mean = 0.5 * (a.squaredNorm() + b.squaredNorm());
  const double area = a.cross(b).norm();
  const double most = std::sqrt(mean + std::sqrt(std::max(mean * mean - area * area, 0.0)));
  return { most, most > 0.0 ? area / most : 0.0 };
}

} // namespace

bool Deformation::map(std::vector<Vec3>& points, double tolerance) const
{
  std::vector<Vec3> back = mapped_ == If::OneToOne ? points : std::vector<Vec3>();
  apply(warp_, &SpaceWarp::forward, points);
  if (mapped_ == If::OneToOne)
  {
    const std::vector<Vec3> before = std::move(back);
    back = points;
    apply(warp_, &SpaceWarp::inverse, back);
    for (std::size_t k = 0; k < back.size(); ++k)
    {
      if (!((back[k] - before[k]).norm() <= tolerance))
      {
        return false;
      }
    }
  }
  return !above_ || above_->map(points, tolerance);
}

SurfaceStretch stretchOf(const Deformation& deformation, const SurfaceSample& sample, double step)
{
  constexpr double kSpoils = 1.25; // longer over shorter, as WarpMesh.cpp has it of triangles
  constexpr double kTolerance = 1e-3;
  std::vector<Vec3> points;
  points.reserve(3 * sample.points.size());
  for (const SurfaceSample::Point& point : sample.points)
  {
    const Vec3 along = point.normal.unitOrthogonal();
    points.push_back(point.place);
    points.emplace_back(point.place + step * along);
    points.emplace_back(point.place + step * point.normal.cross(along));
  }
  SurfaceStretch result;
  result.isOneToOne = deformation.map(points, kTolerance * step);
  double area = 0.0;
  for (std::size_t k = 0; k < sample.points.size() && result.isOneToOne; ++k)
  {
    const Vec3& origin = points[3 * k];
    const auto [most, least] =
      stretches((points[3 * k + 1] - origin) / step, (points[3 * k + 2] - origin) / step);
    result.growth += sample.points[k].area * std::max(most - 1.0, 0.0);
    result.spoilsShapes = result.spoilsShapes || most > kSpoils * least;
    area += sample.points[k].area;
  }
  result.growth /= area > 0.0 ? area : 1.0;
  return result;
}

} // namespace hybridtree
