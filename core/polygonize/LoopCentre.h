// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

struct LoopCentre
{
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero(); ///< the mean of those of the loop, unit length, or 0
};

/// A point of the surface f = T next to the middle of a loop of vertices within a cell; the middle
/// itself where there is none within half a cell.
LoopCentre centreOf(const TriangleMesh& mesh, const std::vector<std::int32_t>& loop,
  const FieldSource& field, double cellSize);

} // namespace hybridtree
