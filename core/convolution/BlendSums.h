// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

inline constexpr std::int32_t kAnyGroup = -1;

/// The field under blending control (BlendedField.h), before the fading of the Cauchy kernel.
///
/// With the compact kernel each unit is integrated once, as the plain sum does it. Where
/// upper bounds of the D_ij from these fields and selection.farthest leave every share 1, the sum
/// is the field: nearly everywhere. The other points are left to mixBlends().
///
/// Overwrites `value`, and `gradient` unless null.
/// \pre selection.isControlled, and the selection is that of a box that holds the points.
/// \param own a group that the points belong to, whose sum alone is taken at the other points
/// (OwnBlend.h); kAnyGroup for the field.
void sumBlends(const BlendGroups& groups, const BlendSelection& selection, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own = kAnyGroup);

} // namespace hybridtree
