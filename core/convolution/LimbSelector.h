// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendPieces.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

///@{
/// Which pieces reach a box, where fields end, and what they are to each other.

/// Whether any two of the elements are of groups that may not blend fully.
bool areGroupsApart(
  const ElementGroups& groups, const BlendPieces& pieces, const ElementSelection& elements);

/// Sets selection.limbs. \return whether any two of the pieces do not blend fully; otherwise there
/// is nothing more to know. \param whole the elements of selection.all, those that reach the box.
bool selectLimbs(const BlendPieces& pieces, const ConvolutionField& whole, const Box3& box,
  BlendSelection& selection);
///@}

} // namespace hybridtree
