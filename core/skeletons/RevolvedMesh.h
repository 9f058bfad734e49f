// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/skeletons/Meridian.h"
#include "core/skeletons/RingMesh.h"

#include <vector>

namespace hybridtree
{

/// Mesh of the closed surface that a meridian makes by turning around frame.axis ([HT] 5.1): rings
/// of points around the axis, joined by strips of triangles and closed by fans where the axis is
/// met.
///
/// A closed 2-manifold by construction, whatever the edge length: points are on the surface and
/// carry its normal; creases are kept, with the mean of their normals. Edges are at most
/// `edgeLength` long, about three quarters of it on average, and up to eight times shorter beside
/// what is smaller: pieces between two creases and stretches of small radius. Rings have as many
/// points as they need, an even number, or all the same where the radius varies little. The planes
/// through the axis along and across frame.side are mirrors of the points, and that of height 0 for
/// a symmetric meridian.
///
/// That the surface does not meet itself is the caller's care, also that of two parts nearer to
/// each other than the triangles are to the surface (about edgeLength^2 / (8 radius)).
/// \pre the meridian has pieces; edgeLength is finite and > 0. \throws TooLarge, naming the
/// estimate, beyond 50 million triangles.
TriangleMesh meshRevolved(const Meridian& meridian, const RevolvedFrame& frame, double edgeLength);

/// Its rings, for meshRings(), closed for a loop. \throws as meshRevolved().
std::vector<Ring> revolvedRings(const Meridian& meridian, double edgeLength);

} // namespace hybridtree
