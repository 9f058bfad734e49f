// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Two cells at a point of a surface that lie on opposite sides of it.
struct Poles
{
  std::int32_t up = -1;   ///< the side that the normal points to, where there is one
  std::int32_t down = -1; ///< either may be -1: none found
  /// The longest edge of the smaller cell over the local spacing: how far the sampling lets one see
  /// on both sides. Infinite if both cells are.
  double strength = 0.0;
};

/// The largest cell at each point, and the largest on the far side of it: around a sampled surface
/// the cells at a point (as its Voronoi cell) are long along the normal, so they tell the two sides
/// apart without any normal being known (Amenta and Bern 1999; Kolluri, Shewchuk, O'Brien 2004 draw
/// the same conclusion from the same poles). Slivers that lie along the surface are passed over:
/// the way to their circumcentre does not agree with the way to their middle.
///
/// \param least poles of less strength are left out.
/// \param normals per point, any length, 0 where unknown; or null. Poles then lie along them.
/// \returns one pair per point. \throws Cancelled.
std::vector<Poles> findPoles(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double least, const std::vector<Vec3>* normals, const Progress& progress = Progress::none());

/// Outward normal of the hull's facet before an infinite cell, of length 1 (0 if it has no area).
Vec3 hullNormal(const Tetrahedralization& tetrahedra, std::int32_t infiniteCell);

} // namespace hybridtree
