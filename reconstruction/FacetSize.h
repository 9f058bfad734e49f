// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include <vector>

namespace hybridtree
{

/// Sizes of edges, facets and tetrahedra relative to how densely points lie around them: the
/// longest edge over the local spacing at its denser end. On the surface of an object about 1 to 4,
/// even for points that were drawn at random; across empty space more.
///
/// The local spacing at a point is the length of its sixth shortest Delaunay edge (the nearest
/// points are among its Delaunay neighbours, so this needs no search), averaged over the points
/// that near.
class FacetSize
{
public:
  explicit FacetSize(const Tetrahedralization& tetrahedra);

  double ofEdge(std::int32_t a, std::int32_t b) const;
  /// \pre the cell is finite.
  double ofFacet(std::int32_t cell, int facet) const;
  /// \pre the cell is finite.
  double ofCell(std::int32_t cell) const;

  /// The same without regard to the spacing: the longest edge, in world units.
  double lengthOfFacet(std::int32_t cell, int facet) const;
  double lengthOfCell(std::int32_t cell) const;

private:
  const Tetrahedralization& tetrahedra_;
  std::vector<double> spacing_; // per point; infinite at duplicates
};

} // namespace hybridtree
