// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendPieces.h"
#include "core/convolution/ConvolutionField.h"

namespace hybridtree
{

/// A piece, and where it is.
struct BlendPiece
{
  const SegmentElement* segment;   ///< or
  const TriangleElement* triangle; ///< null for a segment
  const BlendPieces::Place* place;
};

/// What is known of one group where fields have no end (the Cauchy kernel).
struct FarGroup
{
  ///@{
  /// Pieces, in this order.
  std::vector<const SegmentElement*> segments;
  std::vector<const TriangleElement*> triangles;
  ///@}
  std::vector<const BlendPieces::Place*> places; ///< of them
  CauchyBound bound;
  std::vector<std::int32_t> members; ///< groups of its sum: itself and its neighbours, ascending
  std::vector<std::int32_t> near;    ///< groups that any piece is near, itself too, ascending
  /// Per piece a row of 1 + near.size() numbers: 1, and by how much it is nearer to each of `near`
  /// than what is farthest.
  std::vector<double> nearness;

  std::size_t size() const { return places.size(); }
  std::size_t columns() const { return 1 + near.size(); }
  void findNear(double farthest); ///< sets the two last
};

/// Which elements of a field belong together.
struct ElementGroups
{
  const ConvolutionField& whole;
  const std::vector<std::int32_t>& segments; ///< per element of `whole`, as it was given them
  const std::vector<std::int32_t>& triangles;
  std::size_t count; ///< of groups
};

/// A skeleton in groups, as BlendedField keeps it where neighbours blend.
struct BlendGroups
{
  const BlendingControl& control;
  const ConvolutionField& whole;
  ElementGroups elements;
  const ConvolutionField& pieces;
  const BlendPieces& places;              ///< of the pieces, as that field was given them
  const std::vector<FarGroup>& farGroups; ///< empty with the compact kernel

  std::size_t size() const { return places.neighbours.size(); }
  /// Whether fields end, and groups that do not reach a point have no say there.
  bool isLocal() const { return whole.kernel().kind == KernelKind::Compact; }
};

/// Numbers for some of many groups, in the order in which they are met. In a thread one at a time
/// of each use.
class GroupNumbers
{
public:
  enum Use
  {
    kReaching,
    kCenters
  };

  explicit GroupNumbers(std::size_t groups, Use use = kReaching);
  ~GroupNumbers();
  GroupNumbers(const GroupNumbers&) = delete;
  GroupNumbers& operator=(const GroupNumbers&) = delete;

  std::size_t size() const { return groups_.size(); }
  /// The number of the group, a new one if it has none.
  std::size_t add(std::int32_t group);
  /// -1 for none.
  std::int32_t find(std::int32_t group) const { return numbers_[static_cast<std::size_t>(group)]; }
  std::int32_t group(std::size_t number) const { return groups_[number]; }

private:
  std::vector<std::int32_t>& numbers_; // per group; -1 for none
  std::vector<std::int32_t>& groups_;
};

} // namespace hybridtree
