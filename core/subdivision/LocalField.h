// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/IslandField.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// The field around a skeleton, told by what reaches a place: whatever is made there of equal
/// fields comes out the same to the last bit, so it can be kept while the skeleton is edited
/// elsewhere. Any number of threads may ask.
class LocalField : public IslandField
{
public:
  /// All that the field in some boxes depends on, and the points, radii and pieces of the refined
  /// elements that reach them.
  virtual Dependency around(const std::vector<Box3>& boxes) const = 0;

  /// The same for the sums of some coarse elements alone, as ElementFields with areOwnSums() has
  /// them. \param elements numbered as in PlacedField. \param boxes all that is asked for lies in.
  virtual Dependency ownSums(
    const std::vector<std::int32_t>& elements, const std::vector<Box3>& boxes) const = 0;
};

} // namespace hybridtree
