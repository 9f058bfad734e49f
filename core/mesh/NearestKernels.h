// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshBvh.h"

#include <cstddef>
#include <cstdint>

namespace hybridtree
{

/// Nearest triangles of a mesh to points, with the best instruction set of the processor.
struct NearestQuery
{
  const TriangleMesh* mesh;
  const MeshBvh* bvh;
  /// Where to start in the hierarchy; the root when null.
  const std::vector<std::uint32_t>* roots;
  /// The points taken: order[0 .. count - 1] into `points`, neighbours in space side by side
  /// (sixteen at a time go down the hierarchy together). Null: 0 .. count - 1.
  PointBatch points;
  const std::uint32_t* order;
  std::size_t count;
  double maxDistance;
};

/// For each point k taken: squared[k], infinity where it exceeds maxDistance squared; triangle[k],
/// -1 there. The squared distance is that of one fixed double computation per point and triangle,
/// and the least of all: it does not depend on the order of the points nor on who shares their way.
void findNearest(const NearestQuery& query, double* squared, std::int32_t* triangle);

} // namespace hybridtree
