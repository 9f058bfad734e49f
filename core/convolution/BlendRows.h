// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/PieceFields.h"
#include "core/convolution/ShareKernels.h"

namespace hybridtree
{

/// Every piece of some groups integrated once at a few points, in vectors, for any of the sums G_i
/// over those groups (BlendedField.h) and their gradients.
class BlendRows
{
public:
  static constexpr std::size_t kMostPoints = 64;

  enum Sums
  {
    kOne, ///< of all the groups
    kMany ///< of any of them: what pieces are to each group is kept, by their groups
  };

  /// \param isUsed per number of `pieces`. \pre 1 to kMostPoints points; for kMany all pieces of
  /// the groups, with groups().farGroups.
  BlendRows(const PiecesNear& pieces, const std::vector<char>& isUsed, Sums sums, PointBatch points,
    bool haveGradients);

  /// f of a group, per point.
  const double* field(std::size_t number) const { return groups_.data() + number * kOfGroup; }

  /// G of the groups of the range [begin, end), per point; those of all, for kOne. Valid until the
  /// next.
  const double* sum(const std::size_t* begin, const std::size_t* end);
  /// Of the last sum. \pre haveGradients.
  VectorBatch gradient();

private:
  enum Total // rows
  {
    kWhole,
    kShared,
    kShift,
    kGradient,
    kTotals = kGradient + 3
  };
  enum OfGroup
  {
    kOwn,
    kNear,
    kShare,
    kStep,
    kRows
  };
  static constexpr std::size_t kOfGroup = kRows * kMostPoints;

  struct PlacedPiece
  {
    const BlendPieces::Place* place;
    std::size_t number; // of its group
    std::size_t index;  // among those of that
  };

  double* total(Total row) { return totals_.data() + row * kMostPoints; }
  double* of(std::size_t number, OfGroup row)
  {
    return groups_.data() + number * kOfGroup + row * kMostPoints;
  }
  double* single(std::size_t piece)
  {
    return singles_.data() + piece * (haveGradients_ ? 4 : 1) * kMostPoints;
  }
  const FarGroup& farGroup(std::size_t number) const;
  template <typename Body>
  void forNear(std::size_t piece, const Body& body) const;
  std::size_t findPieces();
  std::size_t findPairs();
  void integrate();
  void findRows(std::size_t piece);
  void addPairs(const std::size_t* begin, const std::size_t* end);

  const PiecesNear& pieces_;
  const ShareKernels& kernels_ = shareKernels();
  BlendShare share_;
  std::vector<char> isUsed_;
  Sums sums_;
  bool haveGradients_;
  std::size_t size_;           // of points, with those that fill the last vector
  std::vector<char> isMember_; // of the last sum, per number
  std::vector<char> varies_;   // its share does in the last sum, per number
  std::vector<const SegmentElement*> segments_;
  std::vector<const TriangleElement*> triangles_;
  std::vector<PlacedPiece> places_;  // of segments, then of triangles
  std::vector<std::size_t> pairsAt_; // per number: first row of pairs_, one for each of `near`
  std::vector<ScaledRow> near_;
  ScratchVectors points_;
  ScratchArray singles_; // per piece: value and gradient
  ScratchArray groups_;  // per number: OfGroup
  ScratchArray pairs_;   // sum of f_c (farthest - d(c, j)) over the pieces c of a group
  ScratchArray totals_;
};

} // namespace hybridtree
