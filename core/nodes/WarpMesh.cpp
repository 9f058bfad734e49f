// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/WarpMesh.h"

#include "core/base/Parallel.h"
#include "core/mesh/Remesh.h"
#include "core/mesh/SmoothNormals.h"
#include "core/nodes/StretchRefiner.h"
#include "core/nodes/WarpImage.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;
constexpr double kLongEdge = 4.0 / 3.0; // edge lengths, as in remeshStretched

void turnInsideOut(TriangleMesh& mesh)
{
  for (Triangle& triangle : mesh.triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
}

// Squared length of the longest side.
double longestSide(const std::vector<Vec3>& points, const Triangle& t)
{
  return std::max({ (points[t[1]] - points[t[0]]).squaredNorm(),
    (points[t[2]] - points[t[1]]).squaredNorm(), (points[t[0]] - points[t[2]]).squaredNorm() });
}

// Height over the longest side, over that side: 0 for a sliver, 0.87 for an equal-sided triangle.
double flatness(const std::vector<Vec3>& points, const Triangle& t)
{
  const double squared = longestSide(points, t);
  const double twiceArea = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
  return squared > 0.0 ? twiceArea / squared : 0.0;
}

// Whether the deformation has made any triangle clearly worse, and bad: slivers that a mesh leaf
// came with are its own. Next to nothing is not halved by rounding, nor by a slight bow.
bool hasBadNewShapes(
  const TriangleMesh& before, const std::vector<Vec3>& after, const Progress& progress)
{
  constexpr double kBad = 0.3;
  constexpr double kWorse = 0.8;
  constexpr double kDrop = 0.02;
  std::atomic<bool> any{ false };
  parallelFor(before.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t t = begin; t < end && !any; ++t)
      {
        const double now = flatness(after, before.triangles[t]);
        const double then = flatness(before.points, before.triangles[t]);
        if (now < kBad && now < kWorse * then && now < then - kDrop)
        {
          any = true;
        }
      }
    });
  return any;
}

double longestEdge(const TriangleMesh& mesh)
{
  std::vector<double> parts((mesh.triangles.size() + kGrain - 1) / kGrain, 0.0);
  parallelFor(mesh.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        parts[begin / kGrain] =
          std::max(parts[begin / kGrain], longestSide(mesh.points, mesh.triangles[t]));
      }
    });
  return parts.empty() ? 0.0 : std::sqrt(*std::max_element(parts.begin(), parts.end()));
}

// Collapses and flips what the deformation has squeezed. Edges that are long still are so because
// the deformation leaves them straight: they stay.
void mendShapes(TriangleMesh& mesh, double edgeLength, const Progress& progress)
{
  double longest = std::max(edgeLength, longestEdge(mesh) / kLongEdge);
  longest *= 1.0 + 1e-9; // the longest edge itself is not to be split by rounding
  RemeshOptions options;
  options.shortEdge *= edgeLength / longest;
  options.edgeLength = longest;
  remeshStretched(mesh, options, nullptr, progress);
}

} // namespace

std::vector<Vec3> pointNormals(const TriangleMesh& mesh)
{
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 normal = areaNormal(mesh, t);
    for (const std::int32_t point : mesh.triangles[t])
    {
      normals[point] += normal;
    }
  }
  for (Vec3& normal : normals)
  {
    normal.stableNormalize();
  }
  return normals;
}

TriangleMesh warpedMesh(const TriangleMesh& mesh, std::vector<Vec3> imagePoints,
  const SpaceWarp& warp, double edgeLength, const Node& node, const Progress& progress)
{
  requireCountableImage(mesh, warp, edgeLength, progress);
  TriangleMesh result = mesh;
  StretchRefiner refiner(result, std::move(imagePoints), warp, edgeLength, node, progress);
  refiner.run();
  progress.report(0.5);
  const double volume = signedVolume(result);
  if (!result.normals.empty())
  {
    mapNormals(warp, result.points, result.normals);
  }
  std::vector<Vec3> image = refiner.takeImage();
  const bool mend = hasBadNewShapes(result, image, progress);
  result.points = std::move(image);
  if (volume * signedVolume(result) < 0.0)
  {
    turnInsideOut(result);
  }
  if (mend)
  {
    mendShapes(result, edgeLength, ProgressPart(progress, 0.5, 1.0));
  }
  if (result.normals.size() != result.points.size())
  {
    result.normals = pointNormals(result);
  }
  else if (node.isFaceted() && result.points.size() != mesh.points.size())
  {
    // New points have the normal of one facet, beside old ones with that of the mesh.
    SmoothNormalsOptions options;
    options.rounds = 1;
    smoothNormals(result, options);
  }
  return result;
}

} // namespace hybridtree
