// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/EllipsoidKernels.h"
#include "core/mesh/TriangleMesh.h"

#include <optional>

namespace hybridtree
{

/// The surface at `radius` >= 0 from an ellipsoid ([HT] 5.1), as OffsetMesh.h has it: rings of
/// points around the longest axis, which divide each meridian evenly by length and are divided
/// evenly themselves, so that edges are near-uniform for any ratio of the axes. Mirror images in
/// the three planes of the ellipsoid have the same points. Where it is thinner than an edge, rings
/// are of 4 points, and triangles as long as that makes them. No value where no such rings have
/// edges short enough.
std::optional<TriangleMesh> meshEllipsoid(
  const EllipsoidShape& ellipsoid, double radius, double edgeLength);

} // namespace hybridtree
