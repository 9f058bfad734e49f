// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendPieces.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

/// A skeleton in groups, as BlendedField has it.
struct BlendGroups
{
  const BlendingControl& control;
  const ConvolutionField& whole;
  const std::vector<std::int32_t>& segmentGroups; ///< per element of `whole`, as it was given them
  const std::vector<std::int32_t>& triangleGroups;
  const ConvolutionField& pieces;
  const BlendPieces& places; ///< of the pieces
};

/// Which groups blend in a box: the clusters of a BlendSelection with these elements in reach.
/// Sums that cannot be the largest anywhere in the box are left out.
std::vector<BlendSelection::Cluster> blendClusters(
  const BlendGroups& groups, const ElementSelection& all, const Box3& box);

} // namespace hybridtree
