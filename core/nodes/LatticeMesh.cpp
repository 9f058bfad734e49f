// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LatticeMesh.h"

#include "core/mesh/SmoothNormals.h"
#include "core/nodes/TriangleSources.h"
#include "core/polygonize/Polygonize.h"
#include "core/polygonize/SharpCreases.h"

namespace hybridtree
{

TriangleMesh latticeMesh(const Node& node, double edgeLength, const Progress& progress)
{
  return latticeMesh(node, CellGrid::ofLevel(edgeLength, 0), progress);
}

TriangleMesh latticeMesh(const Node& node, const CellGrid& grid, const Progress& progress)
{
  if (node.isNegative())
  {
    return {};
  }
  // One cell more, for bounds that are tight and a surface that is flat on them.
  Box3 bounds = node.surfaceBounds();
  if (!bounds.isEmpty())
  {
    bounds.min().array() -= grid.cellSize;
    bounds.max().array() += grid.cellSize;
  }
  PolygonizeOptions options;
  options.cellSize = grid.cellSize;
  options.origin = grid.origin;
  TriangleMesh mesh = polygonize(node, bounds, options, ProgressPart(progress, 0.0, 0.5));
  if (node.isFaceted())
  {
    smoothNormals(mesh);
  }
  sharpenCreases(node, grid.lattice({}, {}), 0, mesh, ProgressPart(progress, 0.5, 1.0));
  findSourceLeaves(node, mesh, 0, progress);
  return mesh;
}

} // namespace hybridtree
