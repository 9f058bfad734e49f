// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Skeleton.h"

#include <string>

namespace hybridtree
{

/// The skeleton that Skeleton::kind() and Skeleton::parameters() describe, with exactly its
/// numbers. Parameters it does not know are left alone. \throws InvalidText for an unknown kind or
/// a missing parameter, InvalidParameter for a value out of range.
SkeletonPtr makeSkeleton(const std::string& kind, const Parameters& parameters);

} // namespace hybridtree
