// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Holes.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/PointCloud.h"

#include "core/base/Error.h"
#include "core/mesh/HalfEdges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr int kNeighbors = 16;
// Places on a triangle are this many to half of what makes a hole, and no more along an edge.
constexpr double kPlaces = 2.0;
constexpr int kMostPlaces = 16;

// Triangles along the border of a hole are of it from this share of its least diameter on.
constexpr double kChord = 0.6;

using Removed = std::vector<std::uint8_t>; // per triangle

double longestEdge(const TriangleMesh& mesh, const Triangle& t)
{
  const auto& p = mesh.points;
  return std::max(
    { (p[t[0]] - p[t[1]]).norm(), (p[t[1]] - p[t[2]]).norm(), (p[t[2]] - p[t[0]]).norm() });
}

// Evenly over a triangle.
void addPlaces(const TriangleMesh& mesh, const Triangle& t, double step, std::vector<Vec3>& places)
{
  const double wanted = std::ceil(longestEdge(mesh, t) / step);
  const int count = static_cast<int>(std::clamp(wanted, 3.0, double(kMostPlaces)));
  for (int i = 0; i <= count; ++i)
  {
    for (int j = 0; i + j <= count; ++j)
    {
      places.push_back((double(i) * mesh.points[t[0]] + double(j) * mesh.points[t[1]] +
                         double(count - i - j) * mesh.points[t[2]]) /
        double(count));
    }
  }
}

// Takes what lies along the border of a hole like a chord: triangles beside it that are longer than
// `most` local spacings.
void growHoles(const ReconstructedSurface& surface, const std::vector<double>& spacing, double most,
  Removed& removed)
{
  const TriangleMesh& mesh = surface.mesh;
  const HalfEdges edges = halfEdges(mesh.triangles);
  std::vector<std::int32_t> stack;
  for (std::size_t t = 0; t < removed.size(); ++t)
  {
    if (removed[t])
    {
      stack.push_back(static_cast<std::int32_t>(t));
    }
  }
  while (!stack.empty())
  {
    const std::int32_t from = stack.back();
    stack.pop_back();
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::int32_t opposite = edges.opposite[3 * from + corner];
      const std::int32_t beyond = opposite < 0 ? from : opposite / 3;
      if (removed[beyond])
      {
        continue;
      }
      const Triangle& v = mesh.triangles[beyond];
      const double sparsest = std::max({ spacing[surface.pointIds[v[0]]],
        spacing[surface.pointIds[v[1]]], spacing[surface.pointIds[v[2]]] });
      if (longestEdge(mesh, v) > most * sparsest)
      {
        removed[beyond] = 1;
        stack.push_back(beyond);
      }
    }
  }
}

// Neighbours are found in PCL's float, in which a few points far off leave no room for the others.
void checkResolution(const std::vector<Vec3>& points, std::vector<double> spacing)
{
  constexpr double kLeastSteps = 10.0; // of float, to a spacing
  Box3 box;
  for (const Vec3& point : points)
  {
    box.extend(point);
  }
  const auto median = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), median, spacing.end());
  if (*median < kLeastSteps * double(std::numeric_limits<float>::epsilon()) * box.diagonal().norm())
  {
    throw InvalidGeometry("Some points are so far from the others that holes cannot be seen among "
                          "these: remove outliers, or close holes.");
  }
}

Removed trianglesOverHoles(const ReconstructedSurface& surface, const std::vector<Vec3>& points,
  double factor, const Progress& progress)
{
  const std::vector<std::int32_t> all = allPoints(points);
  std::vector<double> spacing = surfaceDensity(points, all, kNeighbors, progress);
  std::transform(spacing.begin(), spacing.end(), spacing.begin(),
    [](double density) { return 1.0 / std::sqrt(density); });
  checkResolution(points, spacing);

  const TriangleMesh& mesh = surface.mesh;
  std::vector<std::size_t> triangleOfPlace;
  std::vector<Vec3> places;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& v = mesh.triangles[t];
    const double least = std::min({ spacing[surface.pointIds[v[0]]],
      spacing[surface.pointIds[v[1]]], spacing[surface.pointIds[v[2]]] });
    // No place is farther from all corners than a third of the root of three of the longest edge.
    if (longestEdge(mesh, v) > std::sqrt(3.0) * 0.5 * factor * least)
    {
      addPlaces(mesh, v, 0.5 * factor * least / kPlaces, places);
      triangleOfPlace.resize(places.size(), t);
    }
  }
  const std::vector<NearestPoint> nearest = nearestPoints(points, places, progress);
  Removed removed(mesh.triangles.size(), 0);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    if (nearest[k].distance > 0.5 * factor * spacing[nearest[k].point])
    {
      removed[triangleOfPlace[k]] = 1;
    }
  }
  growHoles(surface, spacing, kChord * factor, removed);
  return removed;
}

using Fans = std::vector<std::vector<std::int32_t>>;

// The triangles at a point, those in one group that hang together by edges at it.
Fans fansOf(const TriangleMesh& mesh, std::int32_t point, const std::vector<std::int32_t>& around)
{
  Fans fans;
  std::vector<std::uint8_t> seen(around.size(), 0);
  const auto shareEdge = [&](std::int32_t a, std::int32_t b)
  {
    int shared = 0;
    for (const std::int32_t corner : mesh.triangles[a])
    {
      const Triangle& other = mesh.triangles[b];
      shared += corner != point && std::find(other.begin(), other.end(), corner) != other.end();
    }
    return shared > 0;
  };
  for (std::size_t seed = 0; seed < around.size(); ++seed)
  {
    if (seen[seed])
    {
      continue;
    }
    seen[seed] = 1;
    std::vector<std::int32_t> fan{ around[seed] };
    for (std::size_t k = 0; k < fan.size(); ++k)
    {
      for (std::size_t other = 0; other < around.size(); ++other)
      {
        if (!seen[other] && shareEdge(fan[k], around[other]))
        {
          seen[other] = 1;
          fan.push_back(around[other]);
        }
      }
    }
    fans.push_back(std::move(fan));
  }
  return fans;
}

// Leaves but the largest fan at each point. \returns whether any went.
bool removeSmallFans(const TriangleMesh& mesh, Removed& removed)
{
  std::vector<std::vector<std::int32_t>> around(mesh.points.size());
  std::vector<std::uint8_t> atBorder(mesh.points.size(), 0); // of what was removed
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t corner : mesh.triangles[t])
    {
      atBorder[corner] |= removed[t];
      if (!removed[t])
      {
        around[corner].push_back(static_cast<std::int32_t>(t));
      }
    }
  }
  bool any = false;
  for (std::size_t point = 0; point < around.size(); ++point)
  {
    if (!atBorder[point])
    {
      continue;
    }
    const Fans fans = fansOf(mesh, static_cast<std::int32_t>(point), around[point]);
    const auto largest = std::max_element(
      fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (auto fan = fans.begin(); fan != fans.end(); ++fan)
    {
      for (std::size_t k = 0; fan != largest && k < fan->size(); ++k)
      {
        removed[(*fan)[k]] = 1;
        any = true;
      }
    }
  }
  return any;
}

void removeCrumbs(const TriangleMesh& mesh, Removed& removed)
{
  constexpr std::size_t kCrumb = 100;
  std::vector<std::int32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](std::int32_t point)
  {
    while (parent[point] != point)
    {
      point = parent[point] = parent[parent[point]];
    }
    return point;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& v = mesh.triangles[t];
    if (!removed[t])
    {
      parent[find(v[0])] = find(v[1]);
      parent[find(v[1])] = find(v[2]);
    }
  }
  std::vector<std::size_t> count(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    count[find(mesh.triangles[t][0])] += !removed[t];
  }
  const std::size_t most = count.empty() ? 0 : *std::max_element(count.begin(), count.end());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    removed[t] |= count[find(mesh.triangles[t][0])] * kCrumb < most;
  }
}

void removeTriangles(ReconstructedSurface& surface, const Removed& removed)
{
  const TriangleMesh old = std::move(surface.mesh);
  const std::vector<std::int32_t> oldIds = std::move(surface.pointIds);
  surface.mesh = {};
  surface.pointIds.clear();
  std::vector<std::int32_t> newPoint(old.points.size(), -1);
  for (std::size_t t = 0; t < old.triangles.size(); ++t)
  {
    if (removed[t])
    {
      continue;
    }
    Triangle triangle = old.triangles[t];
    for (std::int32_t& corner : triangle)
    {
      std::int32_t& point = newPoint[corner];
      if (point < 0)
      {
        point = static_cast<std::int32_t>(surface.mesh.points.size());
        surface.mesh.points.push_back(old.points[corner]);
        surface.pointIds.push_back(oldIds[corner]);
      }
      corner = point;
    }
    surface.mesh.triangles.push_back(triangle);
  }
}

} // namespace

void checkHoleFactor(double factor)
{
  if (!(factor >= 1.0) || !std::isfinite(factor))
  {
    throw InvalidParameter("HoleFactor", factor, "a finite number from 1 on");
  }
}

std::size_t openHoles(ReconstructedSurface& surface, const std::vector<Vec3>& points, double factor,
  const Progress& progress)
{
  checkHoleFactor(factor);
  Removed removed = trianglesOverHoles(surface, points, factor, progress);
  if (std::count(removed.begin(), removed.end(), 1) == 0)
  {
    return 0;
  }
  while (removeSmallFans(surface.mesh, removed))
  {
    progress.check();
  }
  removeCrumbs(surface.mesh, removed);
  if (std::count(removed.begin(), removed.end(), 0) == 0)
  {
    throw InvalidParameter("HoleFactor", factor, "larger: so nothing of the surface is left");
  }
  removeTriangles(surface, removed);
  setAreaNormals(surface.mesh);
  return static_cast<std::size_t>(std::count(removed.begin(), removed.end(), 1));
}

} // namespace hybridtree
