// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/PieceFields.h"
#include "core/convolution/ShareKernels.h"

namespace hybridtree
{

/// Every piece of some groups integrated once at a few points, in vectors, for the sum over those
/// groups (BlendedField.h) and its gradient.
class BlendRows
{
public:
  static constexpr std::size_t kMostPoints = 64;

  /// \param isUsed per number of `pieces`: the group is in the sum. \pre 1 to kMostPoints points.
  BlendRows(const PiecesNear& pieces, const std::vector<char>& isUsed, PointBatch points,
    bool haveGradients);

  const double* sum(); ///< per point
  /// Of the sum. \pre haveGradients; sum() was asked for.
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
  template <typename Body>
  void forNear(std::size_t piece, const Body& body) const;
  std::size_t findPieces();
  void integrate();
  void findRows(std::size_t piece);

  const PiecesNear& pieces_;
  const ShareKernels& kernels_ = shareKernels();
  BlendShare share_;
  std::vector<char> isUsed_;
  bool haveGradients_;
  std::size_t size_;         // of points, with those that fill the last vector
  std::vector<char> varies_; // its share does, per number
  std::vector<const SegmentElement*> segments_;
  std::vector<const TriangleElement*> triangles_;
  std::vector<PlacedPiece> places_; // of segments, then of triangles
  std::vector<ScaledRow> near_;
  ScratchVectors points_;
  ScratchArray singles_; // per piece: value and gradient
  ScratchArray groups_;  // per number: OfGroup
  ScratchArray totals_;
};

} // namespace hybridtree
