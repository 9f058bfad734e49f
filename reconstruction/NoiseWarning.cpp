// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/NoiseWarning.h"

#include "core/mesh/MeshDistance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <memory>
#include <sstream>

namespace hybridtree
{
namespace
{

// Shares of all points.
constexpr double kMany = 0.1;
constexpr double kOnEachSide = 0.02;
constexpr double kStrays = 0.01;
// SmoothingRadius, in median distances of points left out; and in distances between points.
constexpr double kRadius = 4.0;
constexpr double kLeastSpacings = 2.0;
constexpr double kMostSpacings = 5.0;
// Nearer ones, in distances between points, coincide with a vertex.
constexpr double kCoincident = 1e-3;

// Some of the points that no vertex is.
std::vector<Vec3> someLeftOut(const std::vector<Vec3>& points, const ReconstructedSurface& surface)
{
  constexpr std::size_t kSome = 2000;
  std::vector<std::uint8_t> used(points.size(), 0);
  for (const std::int32_t point : surface.pointIds)
  {
    used[point] = 1;
  }
  const std::size_t step = 1 + (points.size() - surface.pointIds.size()) / kSome;
  std::vector<Vec3> some;
  std::size_t left = 0;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    if (!used[point] && left++ % step == 0)
    {
      some.push_back(points[point]);
    }
  }
  return some;
}

// Negative inside.
std::vector<double> signedDistances(const TriangleMesh& mesh, const std::vector<Vec3>& points)
{
  const std::size_t count = points.size();
  std::vector<double> coordinates(3 * count);
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      coordinates[axis * count + k] = points[k][static_cast<Eigen::Index>(axis)];
    }
  }
  std::vector<double> found(count);
  const double* at = coordinates.data();
  MeshDistance(std::make_shared<TriangleMesh>(mesh))
    .signedDistance({ at, at + count, at + 2 * count, count },
      std::numeric_limits<double>::infinity(), found.data(), { nullptr, nullptr, nullptr });
  return found;
}

double meanSpacing(const TriangleMesh& mesh, std::size_t points)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(mesh, t).norm();
  }
  return std::sqrt(area / double(points));
}

} // namespace

void warnOfNoise(const std::vector<Vec3>& points, ReconstructedSurface& surface)
{
  const double all = double(points.size());
  const double left = (all - double(surface.pointIds.size())) / all;
  if (surface.mesh.triangles.empty() || left < kMany)
  {
    return;
  }
  const double spacing = meanSpacing(surface.mesh, points.size());
  std::vector<double> distances = signedDistances(surface.mesh, someLeftOut(points, surface));
  const double each = left / double(distances.size()); // share of all points
  distances.erase(std::remove_if(distances.begin(), distances.end(),
                    [&](double d) { return std::abs(d) < kCoincident * spacing; }),
    distances.end());
  const double inside = each *
    double(std::count_if(distances.begin(), distances.end(), [](double d) { return d < 0.0; }));
  const double off = each * double(distances.size());
  if (off < kMany || std::min(inside, off - inside) < kOnEachSide)
  {
    return;
  }
  std::transform(
    distances.begin(), distances.end(), distances.begin(), [](double d) { return std::abs(d); });
  std::sort(distances.begin(), distances.end());
  const double radius = std::clamp(
    kRadius * distances[distances.size() / 2], kLeastSpacings * spacing, kMostSpacings * spacing);
  const auto strays =
    distances.end() - std::upper_bound(distances.begin(), distances.end(), radius);
  std::ostringstream text;
  text << std::lround(100.0 * off)
       << " % of the points are left out, on both sides of the surface: they are noisy, or parts "
          "are finer than the points are far apart. Against noise, set SmoothingRadius to "
       << std::setprecision(2) << radius;
  if (each * double(strays) > kStrays)
  {
    text << ", and RemoveOutliers on, with OutlierNeighbors 16";
  }
  surface.warnings.push_back(text.str() + ".");
}

} // namespace hybridtree
