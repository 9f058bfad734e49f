// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

/// Sorts the elements of selection.all by groups, each of them a unit: sets selection.units and
/// selection.groups.
void selectGroups(const ElementGroups& groups, BlendSelection& selection);

} // namespace hybridtree
