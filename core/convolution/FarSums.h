// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Scratch.h"
#include "core/convolution/BlendGroups.h"
#include "core/convolution/ShareKernels.h"

#include <algorithm>

namespace hybridtree
{

/// Sums G_i of any groups i at a few points where fields have no end (BlendedField.h), in vectors.
///
/// The pieces of a group are integrated when first asked for, once for all sums. With n(c, j) =
/// farthest - d(c, j) the sums of f_c n(c, j) over all pieces that are known are kept for each j:
/// those over the pieces of one sum are at most these, which bounds it, and differ from them by the
/// pieces of few groups.
///
/// In a thread one at a time.
class FarSums
{
public:
  static constexpr std::size_t kMostPoints = 64;

  /// \pre groups.farGroups; 1 to kMostPoints points.
  FarSums(const BlendGroups& groups, PointBatch points, bool haveGradients);

  bool isKnown(std::int32_t group) const { return isKnown_[static_cast<std::size_t>(group)]; }
  ///@{
  /// Per point, valid until the next call of anything.
  const double* field(std::int32_t group);
  const double* sum(std::int32_t center);
  const double* most(std::int32_t center); ///< at least the sum, for much less
  VectorBatch gradient();                  ///< of the last sum. \pre haveGradients
  ///@}

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
    kNear,    // of all known pieces
    kSetNear, // of those of a sum
    kShare,
    kStep,
    kRows
  };
  struct Known
  {
    std::int32_t group;
    std::size_t pieces; // where they begin in the rows of pieces
  };

  const FarGroup& group(std::int32_t number) const
  {
    return groups_.farGroups[static_cast<std::size_t>(number)];
  }
  double* total(Total row) { return totals_.data() + row * size_; }
  // 0 at first.
  double* of(std::int32_t group, OfGroup row)
  {
    double*& first = rowsOf_[static_cast<std::size_t>(group)];
    if (!first)
    {
      first = rows_.data() + met_++ * kRows * size_;
      std::fill_n(first, kRows * size_, 0.0);
    }
    return first + row * size_;
  }
  std::size_t rowsOfPiece() const { return haveGradients_ ? 4 : 1; }
  void integrate(std::int32_t group);
  bool isMember(std::int32_t group) const { return isMember_[static_cast<std::size_t>(group)]; }
  void beginSum(std::int32_t center);
  void addShares(std::int32_t center, OfGroup near);
  void findSetNear(std::int32_t center);
  void addProducts(const Known& known, double scale);
  void addGradients(const Known& known);

  const BlendGroups& groups_;
  const ShareKernels& kernels_ = shareKernels();
  BlendShare share_;
  bool haveGradients_;
  std::size_t size_; // of points, with those that fill the last vector
  std::vector<Known> known_;
  std::size_t met_ = 0;         // groups that have rows
  std::vector<double*> rowsOf_; // per group: the first; null for none
  std::vector<char> isKnown_;   // per group
  std::vector<char> isMember_;  // of the last sum, per group
  std::vector<char> varies_;    // its share does in the last sum, per group
  std::vector<ProductColumn> to_;
  std::vector<ScaledRow> steps_;
  std::vector<std::size_t> columns_; // of those steps
  std::vector<double>& pieces_;      // rows: per piece a value, or that and a gradient
  ScratchVectors points_;
  ScratchArray rows_; // of groups that are met, in this order
  ScratchArray totals_;
};

} // namespace hybridtree
