// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

/// Which groups may be apart among those of selection.all: sets the rest of `selection`, and sorts
/// these elements by units.
void selectBlends(const BlendGroups& groups, BlendSelection& selection);

/// The same where any two groups may be apart: each is a unit. Sets all but farthest and
/// areUnjoined.
void selectGroups(const ElementGroups& groups, BlendSelection& selection);

} // namespace hybridtree
