// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/PieceFields.h"

namespace hybridtree
{

/// G_i of one group i alone (BlendedField.h), where fields end.
///
/// Every piece of the groups in that sum is integrated once, with its gradient, for all of D_ij.
/// Overwrites `value`, and `gradient` unless null.
/// \param pieces all that reach the points, or all there are, of the members of the sum at least.
void ownBlend(const PiecesNear& pieces, std::int32_t group, PointBatch points, double* value,
  const VectorBatch* gradient);

} // namespace hybridtree
