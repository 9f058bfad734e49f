// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <string>
#include <vector>

namespace hybridtree
{

/// What the user of a blend of these children should know: that a difference or an intersection
/// among them has a sharp solid for an operand, a volume skeleton of surface radius 0. The field of
/// such a solid is T on its surface and all through its inside ([HT] 4.1 with I = T), so that of
/// the Boolean is T as well where something was cut away, and wherever the blend works on the field
/// the hole is lost. Empty where there is none. Each node is looked at once.
std::vector<std::string> warningsOfFlatCuts(const std::vector<NodePtr>& children);

} // namespace hybridtree
