// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/TriangleSources.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

namespace hybridtree
{
namespace
{

constexpr std::size_t kTrianglesPerTask = 512;

} // namespace

void findSourceLeaves(
  const Node& node, TriangleMesh& mesh, std::size_t first, const Progress& progress)
{
  mesh.sourceLeaf.resize(mesh.triangles.size());
  parallelFor(mesh.triangles.size() - first, kTrianglesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      ScratchVectors centroids(end - begin);
      for (std::size_t k = begin; k < end; ++k)
      {
        const Triangle& c = mesh.triangles[first + k];
        centroids.batch().set(
          k - begin, (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0);
      }
      node.sourceLeaf(centroids.points(), &mesh.sourceLeaf[first + begin]);
    });
}

} // namespace hybridtree
