// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendPieces.h"

namespace hybridtree
{

/// A skeleton whose kernel has no end (the Cauchy kernel).
struct FarField
{
  const BlendPieces& pieces;
  const ConvolutionField& whole;
  const ElementSelection& all; ///< all elements of `whole`
};

///@{
/// LimbMeans there. Of all pieces only those are integrated that share with one that may have
/// weight: at a place that is nearly a limb's own, those of that limb within the distance of
/// blending.
void evaluateFarLimbs(
  const FarField& field, PointBatch points, double* value, const VectorBatch* gradient);
Interval farLimbRange(const FarField& field, const Box3& box);
///@}

} // namespace hybridtree
