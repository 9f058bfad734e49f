// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SkeletonKernels.h"
#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

// Direct meshes of the surfaces at a distance from a skeleton ([HT] 5.1, Fig. 14).
//
// Closed 2-manifolds, oriented outward, with exact normals; points are on the surface to rounding.
// Edges are at most `edgeLength` long, and not much shorter where the shape is not smaller than
// that itself. \pre edgeLength is finite and > 0. \throws TooLarge, naming the estimate, beyond 50
// million triangles.

/// Rounded box: an octant of a sphere at each corner, a quadrant of a cylinder along each edge, and
/// six rectangles, which share their seams. A box with two lengths of 0 gives a capsule, one with
/// three a sphere (the octahedron, subdivided). Mirror images of the mesh in the three planes of
/// the box have the same points. Lengths under about a quarter of an edge get no points of their
/// own: the round parts are drawn apart by them. \pre radius > 0.
TriangleMesh meshRoundedBox(const BoxShape& box, double radius, double edgeLength);

/// The box itself. Points on its edges and corners carry the mean of the normals beside them.
/// \pre all lengths > 0.
TriangleMesh meshSharpBox(const BoxShape& box, double edgeLength);

/// Torus around a circle, by meshRevolved(): thin ones have as many points on each
/// ring, and so regular connectivity; fat ones fewer on the inner rings, to keep the edges even.
/// \pre 0 < tube < circle.radius.
TriangleMesh meshTorus(const CircleShape& circle, double tube, double edgeLength);

/// \throws TooLarge when a mesh would have more than 50 million triangles.
void requireModestCount(double triangles, double edgeLength);

} // namespace hybridtree
