// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonPieces.h"
#include "core/subdivision/SlideAxes.h"

#include <vector>

namespace hybridtree
{

/// A piece may have so many vertices; a thinner one would take minutes and all memory.
inline constexpr double kMaxPieceVertices = 2e6;

/// \throws TooLarge for more.
void requirePieceSize(double vertices);

/// A coarse closed mesh around one piece of a skeleton, with an axis for each vertex
/// ([SUB] 4.1, Figures 8 and 9). Closed, oriented outward, a 2-manifold; empty where the piece has
/// no surface, because nowhere along it the field reaches T.
struct PieceCage
{
  std::vector<SkeletonAxis> axes; ///< one per vertex; the base is inside
  std::vector<double> radii;      ///< per vertex: of the skeleton there
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> elements; ///< per triangle: what it surrounds, as SkeletonAxis::element
};

/// Rings of six axes around a curve, in the planes that bisect it, an average radius apart and
/// turned against each other by half a step. An end has rings at 90 and 45 degrees and a pole;
/// where the field is too weak at the very end of the curve these begin where it is strong enough.
/// A curve along which the field falls below T has a closed part on both sides of each such place.
/// \param refined of the coarse skeleton that the piece is of, \param level times.
/// \throws TooLarge where the radius is tiny beside the length.
PieceCage curveCage(
  const CurvePiece& piece, const RefinedSkeleton& refined, int level, const PlacedField& field);

/// Both sides of the triangles and a rim along their borders: at each point axes along the normal
/// and against it, at each border point one outwards. Where the field is too weak at the border the
/// axes begin further inside, and triangles along which it is too weak everywhere are left out.
/// \param refined as above; the cage has its triangles where they are longer than the radius,
/// otherwise larger ones, of fewer steps of subdivision.
PieceCage surfaceCage(
  const SurfacePiece& piece, const RefinedSkeleton& refined, int level, const PlacedField& field);

} // namespace hybridtree
