// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"

namespace hybridtree
{

///@{
/// Blending control where fields have no end (the Cauchy kernel), before they fade: the largest of
/// the sums G_i, or one of them (BlendedField.h). Overwrite `value`, and `gradient` unless null.
/// \pre groups.farGroups.
void mixFarBlends(
  const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient);
void ownFarBlend(const BlendGroups& groups, std::int32_t group, PointBatch points, double* value,
  const VectorBatch* gradient);
///@}

} // namespace hybridtree
