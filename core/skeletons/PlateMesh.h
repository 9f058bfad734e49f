// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/PlateKernels.h"
#include "core/mesh/TriangleMesh.h"

#include <optional>

namespace hybridtree
{

/// The surface at a distance from a plate ([HT] 5.1): two flat faces, half a cylinder along each
/// side, a wedge of a sphere at each convex corner; at a reflex corner the cylinders end in the
/// plane that halves its angle, where the surface has a crease.
///
/// As OffsetMesh.h has it. The two faces mirror each other; parallelograms and near-equilateral
/// triangles have the symmetry of their shape. Points on a crease carry the mean of the two normals
/// there. Triangles become needles on rims thinner than edgeLength and on plates narrower than
/// that. No value where the rim meets itself: in notches narrower than 2 radius, and at sides
/// between reflex corners that are too short for it; nor where edges do not get
/// short enough. \pre radius > 0.
std::optional<TriangleMesh> meshPlate(const PlateShape& plate, double radius, double edgeLength);

} // namespace hybridtree
