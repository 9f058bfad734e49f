// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree::test
{

/// How even a mesh is. \pre it has triangles.
struct MeshShape
{
  double longest = 0.0; ///< edge
  double mean = 0.0;    ///< of the edges
  double needles = 0.0; ///< share of triangles with an angle below 25 degrees
};

MeshShape shapeOf(const TriangleMesh& mesh);

} // namespace hybridtree::test
