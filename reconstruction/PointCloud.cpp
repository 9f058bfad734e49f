// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PointCloud.h"

#include "reconstruction/ParallelSort.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1024;
// Where a point may have all others as neighbours.
constexpr std::size_t kFewer = 64;
// How many times closer than the radius of smoothing points stay apart: half of what is wanted
// afterwards, since points of several layers come to lie side by side.
constexpr double kSmoothingSteps = 8.0;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

// The chosen points in a box of diagonal 2 around 0.
struct FloatCloud
{
  Cloud::Ptr cloud = Cloud::Ptr(new Cloud);
  double scale = 1.0; // float length per world length
  Vec3 center = Vec3::Zero();

  pcl::PointXYZ map(const Vec3& point) const
  {
    const Eigen::Vector3f p = ((point - center) * scale).cast<float>();
    return { p.x(), p.y(), p.z() };
  }
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
  if (!std::isfinite(2.0 * diagonal) || (diagonal > 0.0 && !std::isfinite(2.0 / diagonal)))
  {
    throw InvalidGeometry("The points' extent is more than can be computed with: scale them.");
  }
  result.scale = diagonal > 0.0 ? 2.0 / diagonal : 1.0;
  result.center = chosen.empty() ? Vec3(Vec3::Zero()) : box.center();
  result.cloud->reserve(chosen.size());
  for (const std::int32_t point : chosen)
  {
    result.cloud->push_back(result.map(points[point]));
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

struct Place
{
  std::array<double, 3> coordinates;
  std::size_t index;
  bool operator<(const Place& other) const
  {
    return std::tie(coordinates, index) < std::tie(other.coordinates, other.index);
  }
};

// A point, moved onto the quadratic surface that fits the points around it best.
Vec3 projected(const Vec3& point, const std::vector<Vec3>& around, double radius)
{
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  if (around.size() < 6)
  {
    return point;
  }
  const auto weight = [&](const Vec3& p)
  {
    const double u = 1.0 - (p - point).squaredNorm() / (radius * radius);
    return u > 0.0 ? u * u : 0.0;
  };
  double sum = 0.0;
  Vec3 center = Vec3::Zero();
  for (const Vec3& p : around)
  {
    sum += weight(p);
    center += weight(p) * (p - point);
  }
  center = point + center / sum;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : around)
  {
    spread += weight(p) * (p - center) * (p - center).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread); // smallest first
  const Eigen::Matrix3d axes = solver.eigenvectors();
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Vec6 right = Vec6::Zero();
  for (const Vec3& p : around)
  {
    const Vec3 local = axes.transpose() * (p - point) / radius;
    const double x = local[1];
    const double y = local[2];
    Vec6 basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    normal += weight(p) * basis * basis.transpose();
    right += weight(p) * local[0] * basis;
  }
  normal.diagonal().array() += 1e-9 * normal(0, 0); // points on a line
  const double height = normal.ldlt().solve(right)[0];
  return std::isfinite(height) ? Vec3(point + height * radius * axes.col(0)) : point;
}

// Calls, on several threads, visit(k, nearest, squares) for each point of the cloud: itself and its
// nearest neighbours, in rising order of the squared distances. \pre there are more points than
// neighbors.
template <typename Visit>
void forNeighbors(
  const FloatCloud& scaled, int neighbors, const Progress& progress, const Visit& visit)
{
  progress.check();
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(scaled.cloud);
  parallelFor(scaled.cloud->size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      pcl::Indices nearest;
      std::vector<float> squares;
      for (std::size_t k = begin; k < end; ++k)
      {
        tree.nearestKSearch((*scaled.cloud)[k], neighbors + 1, nearest, squares);
        visit(k, nearest, squares);
      }
    });
}

// Per chosen point, the mean distance to its nearest neighbours, in units of the whole's size.
// \pre there are more points than neighbors.
std::vector<double> meanDistances(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, int neighbors, const Progress& progress)
{
  std::vector<double> distances(chosen.size());
  forNeighbors(toFloat(points, chosen), neighbors, progress,
    [&](std::size_t k, const pcl::Indices&, const std::vector<float>& squares)
    {
      const auto add = [](double sum, float square) { return sum + std::sqrt(double(square)); };
      distances[k] = std::accumulate(squares.begin(), squares.end(), 0.0, add) / neighbors;
    });
  return distances;
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

std::vector<std::int32_t> withoutDuplicates(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, const Progress& progress)
{
  // Equal in double, not merely in PCL's float.
  std::vector<Place> places(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    const Vec3& p = points[chosen[k]];
    places[k] = { { p.x(), p.y(), p.z() }, k };
  }
  parallelSort(places, progress);
  std::vector<std::uint8_t> keep(chosen.size(), 1);
  for (std::size_t k = 1; k < places.size(); ++k)
  {
    keep[places[k].index] = places[k].coordinates != places[k - 1].coordinates;
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
  // As pcl::StatisticalOutlierRemoval does it, which neither looks up nor uses more than one
  // thread.
  const std::vector<double> distances = meanDistances(points, chosen, neighbors, progress);
  const auto count = static_cast<double>(distances.size());
  const double mean = std::accumulate(distances.begin(), distances.end(), 0.0) / count;
  double squares = 0.0;
  for (const double distance : distances)
  {
    squares += (distance - mean) * (distance - mean);
  }
  const double most = mean + deviation * std::sqrt(squares / (count - 1.0));
  std::vector<std::uint8_t> keep(chosen.size(), 0);
  std::transform(distances.begin(), distances.end(), keep.begin(),
    [&](double distance) { return std::uint8_t(distance <= most); });
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

std::vector<std::int32_t> smooth(std::vector<Vec3>& points, const std::vector<std::int32_t>& chosen,
  double radius, const Progress& progress)
{
  if (!(radius > 0.0) || !std::isfinite(radius))
  {
    throw InvalidParameter("SmoothingRadius", radius, "a finite length above 0");
  }
  if (chosen.empty())
  {
    return chosen;
  }
  // Each of those that stay has as many neighbours as stand for it, in all: linear cost.
  const std::vector<std::int32_t> kept =
    thinned(points, chosen, radius / kSmoothingSteps, ProgressPart(progress, 0.0, 0.5));
  std::vector<Vec3> moved(kept.size());
  const FloatCloud scaled = toFloat(points, chosen);
  pcl::search::KdTree<pcl::PointXYZ> tree(false);
  tree.setInputCloud(scaled.cloud);
  const double reach = std::min(radius * scaled.scale, 4.0);
  parallelFor(kept.size(), kFewer,
    [&](std::size_t begin, std::size_t end)
    {
      pcl::Indices near;
      std::vector<float> squared;
      std::vector<Vec3> around;
      for (std::size_t k = begin; k < end; ++k)
      {
        progress.check();
        tree.radiusSearch(scaled.map(points[kept[k]]), reach, near, squared);
        around.resize(near.size());
        std::transform(near.begin(), near.end(), around.begin(),
          [&](int index) { return points[chosen[index]]; });
        moved[k] = projected(points[kept[k]], around, radius);
      }
    });
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    points[kept[k]] = moved[k];
  }
  return kept;
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
  const double pi = std::acos(-1.0);
  forNeighbors(scaled, count, progress,
    [&](std::size_t k, const pcl::Indices&, const std::vector<float>& squares)
    { density[k] = count * scaled.scale * scaled.scale / (pi * double(squares.back())); });
  return density;
}

std::vector<std::int32_t> nearestNeighbors(
  const std::vector<Vec3>& points, int neighbors, const Progress& progress)
{
  const std::size_t count = static_cast<std::size_t>(neighbors);
  std::vector<std::int32_t> result(points.size() * count);
  forNeighbors(toFloat(points, allPoints(points)), neighbors, progress,
    [&](std::size_t k, const pcl::Indices& nearest, const std::vector<float>&)
    {
      std::size_t place = k * count;
      for (const auto index : nearest) // it may not be the first itself, where points coincide
      {
        if (static_cast<std::size_t>(index) != k && place < (k + 1) * count)
        {
          result[place++] = index;
        }
      }
    });
  return result;
}

std::vector<NearestPoint> nearestPoints(
  const std::vector<Vec3>& points, const std::vector<Vec3>& places, const Progress& progress)
{
  const FloatCloud scaled = toFloat(points, allPoints(points));
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(scaled.cloud);
  std::vector<NearestPoint> result(places.size());
  parallelFor(places.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      pcl::Indices nearest;
      std::vector<float> squared;
      for (std::size_t k = begin; k < end; ++k)
      {
        tree.nearestKSearch(scaled.map(places[k]), 1, nearest, squared);
        result[k] = { nearest.front(), (points[nearest.front()] - places[k]).norm() };
      }
    });
  return result;
}

} // namespace hybridtree
