// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

struct SmoothNormalsOptions
{
  /// Normals further apart than this are two sides of a crease and do not mix. Radians.
  double creaseAngle = 0.7;
  /// Each round reaches one more edge around a point.
  int rounds = 3;
};

/// Averages mesh.normals (unit, one per point) with those of the neighbours along the edges,
/// creases kept. For the field of a triangle mesh, whose gradient is constant over each facet:
/// shaded with it, a finer mesh of the same surface would show every facet.
void smoothNormals(TriangleMesh& mesh, const SmoothNormalsOptions& options = {});

} // namespace hybridtree
