// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/WarpImage.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

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

// Area of the image of some triangles: that of each times |cof(J) n| at its centroid. Their corners
// would not do: a twist of many turns takes them anywhere.
double imageArea(
  const TriangleMesh& mesh, const SpaceWarp& warp, std::size_t begin, std::size_t end)
{
  const std::size_t count = end - begin;
  ScratchVectors centroids(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const Triangle& t = mesh.triangles[begin + k];
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
  double area = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    Mat3 inverse;
    inverse << columns[0].batch()[k], columns[1].batch()[k], columns[2].batch()[k];
    const double image =
      (inverse * areaNormal(mesh, begin + k)).norm() / std::abs(inverse.determinant());
    area += std::isfinite(image) ? image : 0.0; // where the map is singular
  }
  return area;
}

double imageArea(const TriangleMesh& mesh, const SpaceWarp& warp, const Progress& progress)
{
  std::vector<double> parts((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      parts[begin / kGrain] = imageArea(mesh, warp, begin, end);
    });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
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
  // Of equal-sided triangles.
  const double estimate =
    imageArea(mesh, warp, progress) / (std::sqrt(3.0) / 4.0 * edgeLength * edgeLength);
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
