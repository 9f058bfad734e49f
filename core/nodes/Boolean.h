// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BooleanField.h"
#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// Union, intersection or difference A - B ([HT] 4.4) with the field functions of BooleanField.h.
///
/// Membership follows the children's by Boolean algebra: max, min, and min(cA, -cB) for the
/// difference. (Departs from [HT], whose step 2 keeps what of A's surface lies inside B.)
/// signedDistance() is exact or NaN: it is the children's distance where no part of the child's
/// surface that was cut away can be the nearest.
/// sourceLeaf() names a leaf of the operand whose surface it is at f = T, for every form.
/// Disjoint, empty and equal operands are answers, not errors.
/// \pre no child is null. \throws InvalidParameter.
NodePtr makeBoolean(
  BooleanOperation operation, NodePtr a, NodePtr b, BooleanForm form = BooleanForm::Automatic);

/// Kind "boolean", children A, B; names "operation" and "form".
NodePtr booleanFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree
