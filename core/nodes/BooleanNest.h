// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Boolean.h"

#include <map>
#include <tuple>
#include <vector>

namespace hybridtree
{

/// Booleans of any number of operands: all united, what all share, or the first less all others.
///
/// They are Booleans of two, nested by halves in the operands' order, so no triangle is cut or
/// copied more often than the logarithm of their number. Those made last are kept and used again
/// with all that they have computed: a changed operand makes anew only what is above it.
/// Not for several threads at once.
class BooleanNest
{
public:
  /// One operand is itself. \pre at least one operand, none null. \throws InvalidParameter.
  NodePtr make(BooleanOperation operation, const std::vector<NodePtr>& operands,
    BooleanForm form = BooleanForm::Automatic, FacetMerging merging = FacetMerging::Parts);

private:
  using Key = std::tuple<BooleanOperation, BooleanForm, FacetMerging, const Node*, const Node*>;
  using Known = std::map<Key, NodePtr>; // each holds its operands, so addresses stay unique

  NodePtr nest(BooleanOperation operation, const NodePtr* begin, const NodePtr* end,
    BooleanForm form, FacetMerging merging, Known& used) const;

  Known known_;
};

} // namespace hybridtree
