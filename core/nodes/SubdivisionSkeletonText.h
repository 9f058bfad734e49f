// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SubdivisionSkeleton.h"

namespace hybridtree
{

/// \throws InvalidParameter where an option is none of its choices.
void checkNames(const SubdivisionSkeletonOptions& options);

} // namespace hybridtree
