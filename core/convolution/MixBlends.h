// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/PieceFields.h"

namespace hybridtree
{

/// The field under blending control by its definition (BlendedField.h), before the fading of the
/// Cauchy kernel: the largest of the sums G_i.
///
/// Each piece near the points is integrated once for all sums (BlendMixture, FarBlends).
///
/// Overwrites `value`, and `gradient` unless null. When groups.isLocal() both hold the plain sum
/// before, and keep it where that is the field.
void mixBlends(
  const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient);

/// The same from the pieces that reach the points. \pre not the Cauchy kernel.
void mixBlends(
  const PiecesNear& pieces, PointBatch points, double* value, const VectorBatch* gradient);

} // namespace hybridtree
