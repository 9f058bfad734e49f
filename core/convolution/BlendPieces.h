// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendingControl.h"
#include "core/convolution/ConvolutionElement.h"
#include "core/convolution/GraphDistances.h"

namespace hybridtree
{

/// The elements again, cut into pieces about half of R apart, each of which is at one distance from
/// every other group: together with the kernels they tell where on the skeleton a point is.
struct BlendPieces
{
  std::vector<SegmentElement> segments;
  std::vector<TriangleElement> triangles;

  /// Of one piece.
  struct Place
  {
    std::int32_t group;
    std::vector<GroupDistance>
      distances; ///< from groups, ascending: itself, 0, and those near enough

    /// From a group; `farthest` unless near enough.
    double from(std::int32_t other, double farthest) const;
  };
  std::vector<Place> segmentPlaces;
  std::vector<Place> trianglePlaces;

  /// Per group, ascending, without itself: those it may blend with. Symmetric.
  std::vector<std::vector<std::int32_t>> neighbours;
  /// Another group, and how far pieces of this one that have fields where that has one are from it
  /// at most.
  struct Meeting
  {
    std::int32_t group;
    bool areNeighbours;
    double farthest;
  };
  /// Per group, ascending: the others that it meets, with the compact kernel.
  std::vector<std::vector<Meeting>> meetings;
};

/// \pre BlendingKind::Neighbours. \throws TooLarge
BlendPieces makeBlendPieces(const GroupedElements& elements, const BlendingControl& control);

} // namespace hybridtree
