// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/nodes/SpaceWarp.h"

#include <vector>

namespace hybridtree
{

/// Replaces the points from `begin` on by their images, in parallel. \throws Cancelled. The same of
/// the others.
void mapForward(
  const SpaceWarp& warp, std::vector<Vec3>& points, std::size_t begin, const Progress& progress);

/// The images of points.
std::vector<Vec3> imageOf(
  const SpaceWarp& warp, std::vector<Vec3> points, const Progress& progress);

/// Replaces the normals at points by those of the image, J^-T n made unit.
void mapNormals(const SpaceWarp& warp, const std::vector<Vec3>& points, std::vector<Vec3>& normals);

/// \throws TooLarge when the image of a mesh has so much area that triangles of that edge length
/// would be more than 2e7.
void requireCountableImage(
  const TriangleMesh& mesh, const SpaceWarp& warp, double edgeLength, const Progress& progress);

} // namespace hybridtree
