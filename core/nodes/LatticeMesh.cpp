// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LatticeMesh.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/mesh/SmoothNormals.h"
#include "core/polygonize/Polygonize.h"

namespace hybridtree
{
namespace
{

constexpr std::size_t kTrianglesPerTask = 512;

void findSourceLeaves(const Node& node, TriangleMesh& mesh, const Progress& progress)
{
  mesh.sourceLeaf.resize(mesh.triangles.size());
  parallelFor(mesh.triangles.size(), kTrianglesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      ScratchVectors centroids(end - begin);
      for (std::size_t t = begin; t < end; ++t)
      {
        const Triangle& c = mesh.triangles[t];
        centroids.batch().set(
          t - begin, (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0);
      }
      node.sourceLeaf(centroids.points(), &mesh.sourceLeaf[begin]);
    });
}

} // namespace

TriangleMesh latticeMesh(const Node& node, double edgeLength, const Progress& progress)
{
  if (node.isNegative())
  {
    return {};
  }
  // One cell more, for bounds that are tight and a surface that is flat on them.
  Box3 bounds = node.surfaceBounds();
  if (!bounds.isEmpty())
  {
    bounds.min().array() -= edgeLength;
    bounds.max().array() += edgeLength;
  }
  PolygonizeOptions options;
  options.cellSize = edgeLength;
  TriangleMesh mesh = polygonize(node, bounds, options, ProgressPart(progress, 0.0, 0.9));
  findSourceLeaves(node, mesh, progress);
  if (node.isFaceted())
  {
    smoothNormals(mesh);
  }
  return mesh;
}

} // namespace hybridtree
