// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonPieces.h"

#include <vector>

namespace hybridtree
{

/// A triangulated sheet, for a cage around it: orientable or not, with points where it touches
/// itself.
struct SheetTriangles
{
  std::vector<Vec3> points;
  std::vector<double> radii;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> elements; ///< per triangle: the coarse one, as SkeletonAxis::element
};

/// A surface piece in triangles about as large as the radius: fewer steps of subdivision than
/// `refined` has (its points in their final places), or after its last step halved edges in the
/// planes of its triangles.
SheetTriangles sheetOf(const SurfacePiece& piece, const RefinedSkeleton& refined, int level);

/// A corner of a sheet: the triangles at a point that hang together by edges there.
struct SheetFan
{
  std::int32_t point = 0;
  std::int32_t element = 0; ///< of one of its triangles
  bool atBorder = false;
  Vec3 normal = Vec3::Zero();  ///< unit, by angles; of one of the two sides, chosen for each fan
  Vec3 outward = Vec3::Zero(); ///< unit, in the sheet, away from it; at borders
  Vec3 inner = Vec3::Zero();   ///< mean of the centers of its triangles
};

/// The fans of a sheet, and how its triangles lie in them.
struct SheetFans
{
  std::vector<SheetFan> fans;
  std::vector<std::array<std::int32_t, 3>> fanOf; ///< per triangle and corner
  std::vector<std::array<bool, 3>> flipped;       ///< the triangle's normal is against the fan's
  /// Borders: triangle and corner at which the edge begins.
  std::vector<std::array<std::int32_t, 2>> borders;
};

SheetFans findFans(const SheetTriangles& sheet);

} // namespace hybridtree
