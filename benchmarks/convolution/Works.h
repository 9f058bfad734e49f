// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SubdivisionSkeleton.h"

#include <functional>
#include <vector>

namespace hybridtree::test
{

using Work = std::function<void()>;

/// Medians in seconds of this thread's processor time, of all works in turns.
std::vector<double> times(const std::vector<Work>& works, int rounds);

NodePtr skeleton(const SkeletonGraph& graph, int level, KernelKind kernel, BlendingKind blending);

inline const char* nameOf(KernelKind kernel)
{
  return kernel == KernelKind::Compact ? "compact" : "cauchy";
}

///@{
/// Print a table each.
void printPlaces(int rounds);
void printKnownElements(int rounds);
void printTriangles(int rounds);
///@}

} // namespace hybridtree::test
