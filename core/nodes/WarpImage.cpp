// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/WarpImage.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 512;
constexpr double kMostTriangles = 2e7; // some 3 GiB

// Twice the areas of the images of triangles first, first + stride, ...: that of each times |cof(J)
// n| at its centroid. Their corners would not do: a twist of many turns takes them anywhere.
void imageAreas(const TriangleMesh& mesh, const SpaceWarp& warp, std::size_t first,
  std::size_t stride, std::size_t count, double* area)
{
  ScratchVectors centroids(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const Triangle& t = mesh.triangles[first + k * stride];
    centroids.batch().set(k, (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0);
  }
  std::array<ScratchVectors, 3> columns{ ScratchVectors(count), ScratchVectors(count),
    ScratchVectors(count) }; // of J^-T
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      columns[axis].batch().set(k, Vec3::Unit(axis));
    }
    warp.pullBack(centroids.points(), columns[axis].batch());
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    Mat3 inverse;
    inverse << columns[0].batch()[k], columns[1].batch()[k], columns[2].batch()[k];
    const double image =
      (inverse * areaNormal(mesh, first + k * stride)).norm() / std::abs(inverse.determinant());
    area[k] = std::isfinite(image) ? image : 0.0; // where the map is singular
  }
}

// By how much a warp makes triangles larger, at most, as far as some of them tell.
double largestGrowth(const TriangleMesh& mesh, const SpaceWarp& warp)
{
  constexpr std::size_t kSamples = 4096;
  const std::size_t stride = mesh.triangles.size() / kSamples + 1;
  const std::size_t count = (mesh.triangles.size() + stride - 1) / stride;
  ScratchArray area(count);
  imageAreas(mesh, warp, 0, stride, count, area.data());
  double largest = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double before = areaNormal(mesh, k * stride).norm();
    largest = before > 0.0 ? std::max(largest, area[k] / before) : largest;
  }
  return largest;
}

// Area, from what is told of triangles begin .. end - 1: twice theirs, as areaNormal() is.
template <typename TwiceArea>
double sumOfAreas(const TriangleMesh& mesh, const Progress& progress, const TwiceArea& twiceAreaOf)
{
  std::vector<double> parts((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      parts[begin / kGrain] = twiceAreaOf(begin, end);
    });
  return 0.5 * std::accumulate(parts.begin(), parts.end(), 0.0);
}

double imageArea(const TriangleMesh& mesh, const SpaceWarp& warp, const Progress& progress)
{
  return sumOfAreas(mesh, progress,
    [&](std::size_t begin, std::size_t end)
    {
      ScratchArray area(end - begin);
      imageAreas(mesh, warp, begin, 1, end - begin, area.data());
      return std::accumulate(area.data(), area.data() + area.size(), 0.0);
    });
}

double ownArea(const TriangleMesh& mesh, const Progress& progress)
{
  return sumOfAreas(mesh, progress,
    [&](std::size_t begin, std::size_t end)
    {
      double sum = 0.0;
      for (std::size_t t = begin; t < end; ++t)
      {
        sum += areaNormal(mesh, t).norm();
      }
      return sum;
    });
}

} // namespace

void mapForward(
  const SpaceWarp& warp, std::vector<Vec3>& points, std::size_t begin, const Progress& progress)
{
  parallelFor(points.size() - begin, kGrain,
    [&](std::size_t from, std::size_t to)
    {
      progress.check();
      ScratchVectors batch(to - from);
      for (std::size_t k = from; k < to; ++k)
      {
        batch.batch().set(k - from, points[begin + k]);
      }
      warp.forward(batch.points(), batch.batch());
      for (std::size_t k = from; k < to; ++k)
      {
        points[begin + k] = batch.batch()[k - from];
      }
    });
}

std::vector<Vec3> imageOf(const SpaceWarp& warp, std::vector<Vec3> points, const Progress& progress)
{
  mapForward(warp, points, 0, progress);
  return points;
}

void mapNormals(const SpaceWarp& warp, const std::vector<Vec3>& points, std::vector<Vec3>& normals)
{
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      ScratchVectors place(end - begin);
      ScratchVectors normal(end - begin);
      for (std::size_t k = begin; k < end; ++k)
      {
        place.batch().set(k - begin, points[k]);
        normal.batch().set(k - begin, normals[k]);
      }
      warp.pullBack(place.points(), normal.batch());
      for (std::size_t k = begin; k < end; ++k)
      {
        normals[k] = normal.batch()[k - begin].stableNormalized();
      }
    });
}

void requireCountableImage(
  const TriangleMesh& mesh, const SpaceWarp& warp, double edgeLength, const Progress& progress)
{
  constexpr double kUnseen = 8.0; // between the triangles that are looked at
  const double one = std::sqrt(3.0) / 4.0 * edgeLength * edgeLength; // equal-sided
  if (kUnseen * largestGrowth(mesh, warp) * ownArea(mesh, progress) / one <= kMostTriangles)
  {
    return;
  }
  const double estimate = imageArea(mesh, warp, progress) / one;
  if (!(estimate <= kMostTriangles))
  {
    std::ostringstream text;
    text << "With an edge length of " << edgeLength << " the deformed mesh would have some "
         << estimate << " triangles; at most " << kMostTriangles
         << " are allowed. Use an edge length of "
         << 1.1 * edgeLength * std::sqrt(estimate / kMostTriangles)
         << " or more, or deform the shape less.";
    throw TooLarge(text.str());
  }
}

} // namespace hybridtree
