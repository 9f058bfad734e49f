// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// What a surface reaches, and at what cost: where points are scattered about a surface, one with a
/// handle or a crumb for every few of them goes through more points than any true one.
struct SurfaceParts
{
  std::size_t points = 0; ///< that it goes through
  /// Pieces, handles, and half the borders: glued to its double along these, a piece has twice as
  /// many handles and one more.
  double parts = 0.0;
};

/// Of the closed boundary of a set of cells. \pre It is a 2-manifold. \throws Cancelled.
SurfaceParts partsOfBoundary(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress);

/// Of a 2-manifold that may have borders.
SurfaceParts partsOfMesh(const TriangleMesh& mesh);

/// Points that each part must bring. A handle that the points resolve has a ring of a dozen about
/// it, and another through it: those of cheese.off, the finest that are found, bring 24 to 27 each
/// at 8,000 points and 52 at 20,000; in noise a handle brings 2 to 15.
constexpr double kPointsOfPart = 20.0;

/// Whether each part that a surface has more than another brings as many points.
bool isPaidByPoints(
  const SurfaceParts& now, const SurfaceParts& before, double pointsOfPart = kPointsOfPart);

} // namespace hybridtree
