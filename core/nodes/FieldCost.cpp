// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FieldCost.h"

#include <algorithm>
#include <unordered_map>

namespace hybridtree
{
namespace
{

// Operands that reach a brick, where there are many.
constexpr std::size_t kFewOperands = 2;

class FieldCosts
{
public:
  explicit FieldCosts(double edgeLength) : edgeLength_(edgeLength) {}

  double of(const Node& node)
  {
    const auto [known, isNew] = known_.emplace(&node, 0.0);
    if (!isNew)
    {
      return known->second;
    }
    const double cost = node.sampleCost(this->below(node), edgeLength_);
    known_[&node] = cost;
    return cost;
  }

private:
  double below(const Node& node)
  {
    const std::vector<NodePtr> children = node.children();
    double sum = 0.0;
    for (const NodePtr& child : children)
    {
      sum += this->of(*child);
    }
    const auto near = static_cast<double>(std::min(children.size(), kFewOperands));
    return children.empty() ? 0.0 : sum * near / static_cast<double>(children.size());
  }

  const double edgeLength_;
  std::unordered_map<const Node*, double> known_; // a chain of shared nodes has many paths
};

} // namespace

double fieldCost(const Node& node, double edgeLength)
{
  return FieldCosts(edgeLength).of(node);
}

} // namespace hybridtree
