// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LatticeMesh.h"

#include "core/mesh/SmoothNormals.h"
#include "core/nodes/TriangleSources.h"
#include "core/polygonize/Polygonize.h"

namespace hybridtree
{

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
  findSourceLeaves(node, mesh, 0, progress);
  if (node.isFaceted())
  {
    smoothNormals(mesh);
  }
  return mesh;
}

} // namespace hybridtree
