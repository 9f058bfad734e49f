// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <vector>

namespace hybridtree
{

/// Triangles over a region of the plane given by its borders: outer ones counter-clockwise, those
/// of holes clockwise, in the plane of the right-handed axes (place).
///
/// Always n - 2 triangles for a border of n points that has no hole, and two more for every point
/// of a hole and for the hole, whatever rounding has done to the points: every side is used exactly
/// once, in its direction. Triangles turn counter-clockwise wherever the borders allow.
///
/// \param borders each at least three numbers of places. \param place of every number.
std::vector<Triangle> fillPolygon(
  std::vector<std::vector<std::int32_t>> borders, const std::vector<Eigen::Vector2d>& place);

} // namespace hybridtree
