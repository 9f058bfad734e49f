// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"

#include "core/base/Types.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// How much of a point set a surface shall keep: one of tolerance and vertices.
struct LevelOfDetail
{
  /// Greatest distance of any input point to the surface, world units, > 0; 0: not asked for.
  double tolerance = 0.0;
  /// Vertices of the surface, >= 4; 0: not asked for. Met within 2 in 100, unless the input has
  /// not so many points that the surface can use, or they are too few to tell inside from outside.
  std::size_t vertices = 0;
  /// Box with a tolerance of its own; empty: none. Its vertices come on top of those above.
  Box3 region = {};
  /// Greatest distance of the points in the box to the surface, world units, >= 0; 0: all points
  /// are used.
  double regionTolerance = 0.0;
};

/// A surface of part of the points: dense where it bends, sparse where it is flat. For one level of
/// detail; DynamicReconstruction.h has how it works, and keeps what is made for others.
///
/// Points that stay beyond the tolerance whatever is done (inside a solid, or far outliers) are
/// counted in a warning. Sheets thinner than the tolerance may be lost.
/// \param points in any order, as many as fit: an unused one takes about 150 bytes.
/// \throws as reconstruct() of all points.
ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options = {}, const Progress& progress = Progress::none());

} // namespace hybridtree
