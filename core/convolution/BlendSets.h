// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/PieceFields.h"

namespace hybridtree
{

/// The different sets of groups that the sums G_i have at some points, by the numbers that groups
/// have in PieceFields. Those that may be largest come first.
class BlendSets
{
public:
  struct Set
  {
    const std::size_t* begin; ///< members, ascending
    const std::size_t* end;
    double bound; ///< of G_i at any of the points
  };

  /// \param bounds per number: of its field at any of the points. Groups with 0 are in no set.
  BlendSets(const PiecesNear& pieces, const std::vector<double>& bounds);

  std::size_t size() const { return ranges_.size(); }
  Set operator[](std::size_t k) const;

private:
  struct Range
  {
    std::size_t begin, end; // of members_
    double bound;
  };

  std::vector<std::size_t> members_;
  std::vector<Range> ranges_;
};

} // namespace hybridtree
