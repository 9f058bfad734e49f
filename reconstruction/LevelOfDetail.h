// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// How much of a point set a surface shall keep: one of the two.
struct LevelOfDetail
{
  /// Greatest distance of any input point to the surface, world units, > 0; 0: not asked for.
  double tolerance = 0.0;
  /// Vertices of the surface, >= 4; 0: not asked for. Met within 2 in 100, unless the input has
  /// not so many points that the surface can use.
  std::size_t vertices = 0;
};

/// A surface of part of the points: dense where it bends, sparse where it is flat ([HT] 3; Allegre,
/// Chaine, Akkouche, Convection-driven dynamic surface reconstruction, SMI 2005).
///
/// A subset of the points, chosen by roughness (PointOctree.h), is reconstructed by static
/// convection. Then the input points that lie farthest from the surface are added, some per round
/// and spread over the surface; tetrahedralization and surface follow locally (DynamicSurface.h).
/// Only points that are used are ever triangulated. A point that the surface cannot take up without
/// changing its topology is added to the tetrahedralization, and convection starts from the hull
/// again.
///
/// Departs from the paper: there points are taken out where the flow finds too many; here they are
/// put in where there are too few.
/// Points that stay beyond the tolerance whatever is done (inside a solid, or far outliers) are
/// counted in a warning. Sheets thinner than the tolerance may be lost.
/// \param points in any order, as many as fit: an unused one takes about 150 bytes.
/// \throws as reconstruct() of all points.
ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options = {}, const Progress& progress = Progress::none());

} // namespace hybridtree
