// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Scratch.h"
#include "core/convolution/BlendGroups.h"

namespace hybridtree
{

/// Pieces near some points, by groups. Groups have numbers here.
class PiecesNear
{
public:
  /// Those that reach a box, and their groups.
  PiecesNear(const BlendGroups& groups, const Box3& box);

  const BlendGroups& groups() const { return groups_; }
  std::size_t size() const { return pieces_.size(); }
  const BlendPiece& operator[](std::size_t k) const { return pieces_[k]; }

  std::size_t groupCount() const { return numbers_.size(); }
  std::int32_t group(std::size_t number) const { return numbers_.group(number); }
  std::int32_t find(std::int32_t group) const { return numbers_.find(group); } ///< -1 for none
  ///@{
  /// Of a group: its first piece, and the first behind.
  std::size_t begin(std::size_t number) const { return begin_[number]; }
  std::size_t end(std::size_t number) const { return begin_[number + 1]; }
  ///@}

private:
  const BlendGroups& groups_;
  GroupNumbers numbers_;
  std::vector<BlendPiece> pieces_;
  std::vector<std::size_t> begin_;
};

/// The fields f_c at some points of pieces c, and the distances d(c, j) between them and groups
/// (BlendedField.h). Integrated when first asked for.
class PieceFields
{
public:
  PieceFields(const PiecesNear& pieces, PointBatch points);

  const PiecesNear& pieces() const { return pieces_; }
  PointBatch points() const { return points_; }

  bool isKnown(std::size_t number) const { return isKnown_[number]; }
  /// Of a group: the sum of f_c over its pieces, per point.
  const double* field(std::size_t number);
  /// The sum of f_c d(c, j) over the pieces of a group. Valid until the next call.
  const double* far(std::size_t number, std::size_t j);
  /// Overwrites `rows`: per group j and point the sum of f_c (farthest - d(c, j)) over all pieces
  /// c.
  void findNearness(double* rows);
  /// d(c, j) for all numbers j. \pre field() of its group was asked for.
  const double* distances(std::size_t piece) const
  {
    return distances_.data() + distancesAt_[piece];
  }
  void addFieldAndGradient(
    std::size_t piece, PointBatch points, double* value, VectorBatch gradient) const;

private:
  void integrate(std::size_t number);
  double* row(ScratchArray& rows, std::size_t k) const { return rows.data() + k * points_.size; }

  const PiecesNear& pieces_;
  const ConvolutionKernel& kernel_;
  const ConvolutionKernels& kernels_;
  double farthest_;
  PointBatch points_;
  std::vector<char> isKnown_;            // per group
  std::vector<std::size_t> distancesAt_; // per piece
  std::vector<double> distances_;        // per group, of pieces of known ones
  std::vector<std::int32_t> farAt_;      // per pair of groups: a row of far_, or -1
  std::vector<double> far_;              // rows
  ScratchArray single_;                  // per piece and point
  ScratchArray fields_;                  // per group and point
};

} // namespace hybridtree
