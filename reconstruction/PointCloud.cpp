// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PointCloud.h"

#include "core/base/Error.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

namespace hybridtree
{
namespace
{

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

// The chosen points in a box of diagonal 2 around 0.
struct FloatCloud
{
  Cloud::Ptr cloud = Cloud::Ptr(new Cloud);
  double scale = 1.0; // float length per world length
};

FloatCloud toFloat(const std::vector<Vec3>& points, const std::vector<std::int32_t>& chosen)
{
  Box3 box;
  for (const std::int32_t point : chosen)
  {
    if (!points[point].allFinite())
    {
      throw InvalidGeometry("Point " + std::to_string(point) +
        " has a coordinate that is not a finite number: remove it, or mend it where it was made.");
    }
    box.extend(points[point]);
  }
  FloatCloud result;
  const double diagonal = chosen.empty() ? 0.0 : box.diagonal().stableNorm();
  result.scale = diagonal > 0.0 && std::isfinite(diagonal) ? 2.0 / diagonal : 1.0;
  result.cloud->reserve(chosen.size());
  for (const std::int32_t point : chosen)
  {
    const Eigen::Vector3f p = ((points[point] - box.center()) * result.scale).cast<float>();
    result.cloud->push_back({ p.x(), p.y(), p.z() });
  }
  return result;
}

std::vector<std::int32_t> pick(
  const std::vector<std::int32_t>& chosen, const std::vector<std::uint8_t>& keep)
{
  std::vector<std::int32_t> kept;
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    if (keep[k])
    {
      kept.push_back(chosen[k]);
    }
  }
  return kept;
}

void tell(const Progress& progress, std::size_t done, std::size_t all)
{
  if (done % 1024 == 0)
  {
    progress.check();
    progress.report(double(done) / double(all));
  }
}

} // namespace

std::vector<std::int32_t> allPoints(const std::vector<Vec3>& points)
{
  std::vector<std::int32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<std::int32_t> withoutDuplicates(
  const std::vector<Vec3>& points, const std::vector<std::int32_t>& chosen)
{
  // Equal in double, not merely in PCL's float.
  std::vector<std::size_t> order(chosen.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto coordinates = [&](std::size_t k) -> const Vec3& { return points[chosen[k]]; };
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      const Vec3& p = coordinates(a);
      const Vec3& q = coordinates(b);
      return std::tie(p.x(), p.y(), p.z(), a) < std::tie(q.x(), q.y(), q.z(), b);
    });
  std::vector<std::uint8_t> keep(chosen.size(), 1);
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    keep[order[k]] = coordinates(order[k]) != coordinates(order[k - 1]);
  }
  return pick(chosen, keep);
}

std::vector<std::int32_t> withoutOutliers(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, int neighbors, double deviation,
  const Progress& progress)
{
  if (neighbors < 1)
  {
    throw InvalidParameter("OutlierNeighbors", neighbors, "at least 1");
  }
  if (!(deviation >= 0.0) || !std::isfinite(deviation))
  {
    throw InvalidParameter("OutlierDeviation", deviation, "a finite number, 0 or more");
  }
  if (chosen.size() <= static_cast<std::size_t>(neighbors))
  {
    return chosen; // nobody has that many neighbours
  }
  progress.check();
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(toFloat(points, chosen).cloud);
  filter.setMeanK(neighbors);
  filter.setStddevMulThresh(deviation);
  pcl::Indices kept;
  filter.filter(kept);
  progress.check();
  std::vector<std::uint8_t> keep(chosen.size(), 0);
  for (const auto index : kept)
  {
    keep[index] = 1;
  }
  return pick(chosen, keep);
}

std::vector<std::int32_t> thinned(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, double spacing, const Progress& progress)
{
  if (!(spacing >= 0.0) || !std::isfinite(spacing))
  {
    throw InvalidParameter("Spacing", spacing, "a finite length, 0 (keep all points) or more");
  }
  if (spacing == 0.0 || chosen.empty())
  {
    return chosen;
  }
  const FloatCloud scaled = toFloat(points, chosen);
  pcl::search::KdTree<pcl::PointXYZ> tree(false);
  tree.setInputCloud(scaled.cloud);
  std::vector<std::uint8_t> keep(chosen.size(), 1);
  pcl::Indices covered;
  std::vector<float> squaredDistances;
  // Beyond the whole cloud's extent every radius is alike, and float has no room for it.
  const double radius = std::min(spacing * scaled.scale, 4.0);
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    tell(progress, k, chosen.size());
    if (!keep[k])
    {
      continue;
    }
    tree.radiusSearch((*scaled.cloud)[k], radius, covered, squaredDistances);
    for (const auto index : covered)
    {
      if (static_cast<std::size_t>(index) > k)
      {
        keep[index] = 0;
      }
    }
  }
  return pick(chosen, keep);
}

std::vector<double> surfaceDensity(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, int neighbors, const Progress& progress)
{
  if (neighbors < 1)
  {
    throw InvalidParameter("neighbors", neighbors, "at least 1");
  }
  std::vector<double> density(chosen.size(), 0.0);
  if (chosen.size() < 2)
  {
    return density;
  }
  const int count = std::min(neighbors, static_cast<int>(chosen.size()) - 1);
  const FloatCloud scaled = toFloat(points, chosen);
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(scaled.cloud);
  pcl::Indices nearest;
  std::vector<float> squaredDistances;
  const double pi = std::acos(-1.0);
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    tell(progress, k, chosen.size());
    tree.nearestKSearch((*scaled.cloud)[k], count + 1, nearest, squaredDistances); // and itself
    density[k] = count * scaled.scale * scaled.scale / (pi * double(squaredDistances.back()));
  }
  return density;
}

} // namespace hybridtree
