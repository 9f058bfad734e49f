// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <functional>

namespace hybridtree::benchmark
{

/// Distances to a mesh by another library: one point after the other, on one thread, unbounded.
/// distance[k] may be signed.
using PeerDistance = std::function<void(PointBatch points, double* distance)>;

/// CGAL's AABB tree with its accelerating k-d tree, in its inexact kernel.
PeerDistance cgalDistance(const TriangleMesh& mesh);

/// vtkImplicitPolyDataDistance.
PeerDistance vtkDistance(const TriangleMesh& mesh);

} // namespace hybridtree::benchmark
