// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

/// Bounds of the fields of pieces in a box, and what they make of the means of their limbs: the
/// least and the largest weighted mean that any weights within their bounds have.
class LimbRanges
{
public:
  /// \param fields of each piece by its number, 0 for those that are not asked for.
  LimbRanges(const std::vector<Interval>& fields, PieceRows sights, PieceRows shares)
    : fields_(fields), sights_(sights), shares_(shares)
  {
  }

  /// Of the mean over all pieces from centers[0] to centers[count - 1].
  Interval mean(const std::uint32_t* centers, std::size_t count) const;

private:
  Interval product(PieceRows rows, std::uint32_t piece) const;

  const std::vector<Interval>& fields_;
  PieceRows sights_;
  PieceRows shares_;
};

/// LimbMeans::range() where fields end. \param whole all elements.
Interval localLimbRange(
  const ConvolutionField& whole, const BlendSelection& selection, const Box3& box);

} // namespace hybridtree
