// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Blend.h"

namespace hybridtree
{

/// Local blend ([HT] 4.3, after Pasko et al.): A and B blend where the region C is, and are united
/// elsewhere: f = c (fA + fB) + (1 - c) union(fA, fB), c = fC clamped to [0, 1].
///
/// The union is the smooth one (BooleanField.h), so that the sum and the union meet smoothly; where
/// C ends there is nothing but it. Departs from [HT]: a region that is negative everywhere is
/// clamped to 0 and so leaves the union as it is, where [HT] would empty its bounding box, against
/// its own field. \pre no child is null; overlapThreshold in [0, 1]. \throws InvalidParameter.
NodePtr makeLocalBlend(NodePtr a, NodePtr b, NodePtr region, const BlendOptions& options = {});

/// Kind "localBlend", children A, B, region.
NodePtr localBlendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree
