// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/RawVector.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Sizes of facets and tetrahedra relative to how densely points lie around them: the longest edge
/// over the local spacing. On the surface of an object about 1 to 4, even for points that were
/// drawn at random; across empty space more.
///
/// The local spacing at a point is the length of its sixth shortest Delaunay edge (the nearest
/// points are among its Delaunay neighbours, so this needs no search), averaged over the points
/// that near. Threads may share it.
class FacetSize
{
public:
  /// \throws Cancelled.
  explicit FacetSize(
    const Tetrahedralization& tetrahedra, const Progress& progress = Progress::none());

  /// The local spacing at a point; infinite at a duplicate.
  double spacing(std::int32_t point) const { return spacing_[point]; }

  /// Over the spacing at each edge's denser end, the widest edge counts: what may be wide.
  /// \pre the cell is finite.
  float ofFacet(std::int32_t cell, int facet) const { return facets_[cell][facet]; }
  void prefetch(std::int32_t cell) const
  {
#if defined(__GNUC__)
    if (tetrahedra_.finite(cell))
    {
      __builtin_prefetch(&facets_[cell]);
    }
#endif
  }
  /// The same of a tetrahedron. \pre the cell is finite.
  float ofCell(std::int32_t cell) const
  {
    const auto& size = facets_[cell]; // three facets have all six edges
    return std::max({ size[0], size[1], size[2] });
  }
  /// Over the spacing at the sparsest corner: what is wide for certain, since a cluster of points
  /// at one corner does not widen it. At most ofFacet. \pre the cell is finite.
  double certainOfFacet(std::int32_t cell, int facet) const;

  /// The same without regard to the spacing: the longest edge, in world units.
  double lengthOfFacet(std::int32_t cell, int facet) const;
  float lengthOfCell(std::int32_t cell) const
  {
    return lengths_[cell];
  }

private:
  void findSpacing(const Progress& progress);
  void measureCells(const Progress& progress);

  const Tetrahedralization& tetrahedra_;
  std::vector<double> spacing_;            // per point; infinite at duplicates
  RawVector<std::array<float, 4>> facets_; // per finite cell
  RawVector<float> lengths_;
};

} // namespace hybridtree
