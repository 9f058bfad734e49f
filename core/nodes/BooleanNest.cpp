// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanNest.h"

#include "core/base/Error.h"

#include <algorithm>

namespace hybridtree
{

NodePtr BooleanNest::make(BooleanOperation operation, const std::vector<NodePtr>& operands,
  BooleanForm form, FacetMerging merging)
{
  if (operands.empty())
  {
    throw InvalidParameter("Number of operands", 0.0, "at least 1");
  }
  if (std::count(operands.begin(), operands.end(), nullptr) > 0)
  {
    throw InvalidParameter("Operand", "null", "a node");
  }
  Known used;
  NodePtr all =
    this->nest(operation, operands.data(), operands.data() + operands.size(), form, merging, used);
  known_ = std::move(used);
  return all;
}

NodePtr BooleanNest::nest(BooleanOperation operation, const NodePtr* begin, const NodePtr* end,
  BooleanForm form, FacetMerging merging, Known& used) const
{
  if (end - begin == 1)
  {
    return *begin;
  }
  const bool cuts = operation == BooleanOperation::Difference;
  const NodePtr* middle = begin + (cuts ? 1 : (end - begin + 1) / 2);
  const NodePtr a = this->nest(operation, begin, middle, form, merging, used);
  const NodePtr b =
    this->nest(cuts ? BooleanOperation::Union : operation, middle, end, form, merging, used);
  const Key key(operation, form, merging, a.get(), b.get());
  const auto found = known_.find(key);
  NodePtr node =
    found != known_.end() ? found->second : makeBoolean(operation, a, b, form, merging);
  used[key] = node;
  return node;
}

} // namespace hybridtree
