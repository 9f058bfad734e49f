// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Polygon.h"

#include "core/base/Error.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"

namespace hybridtree
{

PolygonSkeleton::PolygonSkeleton(std::vector<Vec3> points)
  : PlateSkeleton(plateThrough("Points", points, kFlatness)), points_(std::move(points))
{
}

SkeletonPtr PolygonSkeleton::similarityImage(const Affine3& map, double) const
{
  std::vector<Vec3> points = points_;
  for (Vec3& point : points)
  {
    point = map * point;
  }
  return std::make_shared<PolygonSkeleton>(std::move(points));
}

Parameters PolygonSkeleton::parameters() const
{
  std::vector<double> numbers;
  for (const Vec3& point : points_)
  {
    numbers.insert(numbers.end(), point.begin(), point.end());
  }
  Parameters parameters;
  parameters.set("points", std::move(numbers));
  return parameters;
}

SkeletonPtr PolygonSkeleton::fromParameters(const Parameters& parameters)
{
  const std::vector<double> numbers = parameters.getDoubles("points");
  if (numbers.size() % 3 != 0)
  {
    throw InvalidText("Parameter \"points\" is not a list of points, three numbers each.");
  }
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < numbers.size(); k += 3)
  {
    points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  }
  return std::make_shared<PolygonSkeleton>(std::move(points));
}

SkeletonPtr makePolygon(std::vector<Vec3> points, int levelOfDetail)
{
  auto full = std::make_shared<PolygonSkeleton>(points);
  const SplineCurve outline = requireCurve({ std::move(points), {}, SplineKind::Polyline, true });
  SplineCurve fewer = simplified(outline, detailTolerance(outline, levelOfDetail));
  if (fewer.points.size() == outline.points.size())
  {
    return full;
  }
  try
  {
    return std::make_shared<PolygonSkeleton>(std::move(fewer.points));
  }
  catch (const InvalidParameter&)
  {
    return full;
  }
}

} // namespace hybridtree
