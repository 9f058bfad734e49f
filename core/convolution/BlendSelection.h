// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionField.h"
#include "core/convolution/PieceWeights.h"

#include <vector>

namespace hybridtree
{

/// What the field in a box is made of.
struct BlendSelection
{
  /// Of one group: elements in a row of `all`, from where those of the unit before end.
  struct Unit
  {
    std::size_t segmentsEnd;
    std::size_t trianglesEnd;
  };
  struct Group
  {
    std::int32_t group;
    std::size_t unit;
  };

  /// The pieces that reach the box, by numbers of their own, and what they are to each other
  /// (LimbMeans.h).
  struct Limbs
  {
    std::vector<const SegmentElement*> segments;
    std::vector<const TriangleElement*> triangles;
    std::size_t ofSegments; ///< pieces; the others are of triangles
    ///@{
    /// Per piece, of its kind: its first element; and the first behind the last.
    std::vector<std::uint32_t> segmentsBegin;
    std::vector<std::uint32_t> trianglesBegin;
    ///@}
    std::vector<std::uint32_t> pieces; ///< their numbers among all
    ///@{
    /// Sparse matrices: rows begin, and weights.
    std::vector<std::uint32_t> sightsBegin, sharesBegin;
    std::vector<PieceWeight> sights, shares;
    ///@}
  };

  ElementSelection all;      ///< all elements that reach the box
  bool isControlled = false; ///< not everything adds up
  ///@{
  /// With BlendingKind::Paper: groups that reach the box.
  std::vector<Unit> units;
  std::vector<Group> groups;
  ///@}
  Limbs limbs; ///< with BlendingKind::Neighbours where isControlled and fields end

  bool empty() const { return all.empty(); }
  ElementSpans elementsOf(std::size_t unit) const
  {
    const Unit first = unit == 0 ? Unit{ 0, 0 } : units[unit - 1];
    return {
      { all.segments.data() + first.segmentsEnd, units[unit].segmentsEnd - first.segmentsEnd },
      { all.triangles.data() + first.trianglesEnd, units[unit].trianglesEnd - first.trianglesEnd }
    };
  }
};

} // namespace hybridtree
