// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Regions.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

struct SideOptions
{
  /// Size of facets from which they are wide.
  double wide = 1.0;
  /// Size from which a facet is a passage, whatever lies behind it; >= wide.
  double mouth = 6.0;
  /// The surface may be open: what is around the convex hull is then not one, but told apart by the
  /// surface as what is within is, and infinite cells have regions too.
  bool open = false;
  /// What poles that see far count for against facets of the same size. Less than 1 lets the inside
  /// run out where a part as wide as the object is missing.
  double poles = 0.7;
  /// Per point, outward, any length, 0 where unknown; null: none are known.
  const std::vector<Vec3>* normals = nullptr;
};

/// Tells the empty space on one side of a surface from that on the other, as findRegions() does,
/// but by a watershed of two colours: slower, and for surfaces that are open, full of pores, or
/// come with normals.
///
/// Facets are taken from the widest to the narrowest, each joins the regions on its two sides under
/// the same conditions. Among them come the poles of the points
/// (Poles.h), by how far they see: they join two regions as opposite ones. A join that contradicts
/// those before it is left out. So which side a tetrahedron falls to is decided by its widest ways
/// out and by the points that see most, not by who comes first; a wall that is full of pores has
/// two sides still. (Greedy signed clustering as in Wolf et al., The mutex watershed, 2018, for two
/// labels.) Where normals are known, poles are taken along them; around a solid their signs do not
/// matter, on an open surface they tell the outside.
/// \returns one region per cell. Without normals an open surface has its outside where more of the
/// hull is. \throws Cancelled.
std::vector<Region> findSides(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const SideOptions& options = {}, const Progress& progress = Progress::none());

} // namespace hybridtree
