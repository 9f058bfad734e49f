// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonGraph.h"

namespace hybridtree
{

enum class SubdivisionScheme
{
  Approximating, ///< Loop's, with uniform cubic B-splines for curves, borders and creases
  Interpolating  ///< modified butterfly, with the four-point scheme for curves, borders and creases
};

inline constexpr int kMaxSubdivisionLevel = 6;

/// The skeleton after `level` steps of subdivision ([SUB] 3.1, 3.2): every segment in halves, every
/// triangle in quarters. Radii move by the masks of the points.
///
/// What meets stays together (SkeletonTopology says who leads). Where a curve ends it goes on as
/// its own point reflection, which is cubic B-splines with natural ends and keeps the end's place.
/// The butterfly's stencil goes on over a border by parallelograms, so that a border is the same
/// four-point curve whether asked as curve or as surface. The interpolating masks have negative
/// weights: a radius they make smaller than half of both neighbours' is half of the smaller one.
/// Borders: Biermann, Levin, Zorin 2000 (see SubdivisionMasks.h).
///
/// \throws InvalidParameter unless 0 <= level <= 6. \throws TooLarge beyond 4 million elements.
/// \throws InvalidGeometry as validate().
RefinedSkeleton subdivide(const SkeletonGraph& graph, SubdivisionScheme scheme, int level);

} // namespace hybridtree
