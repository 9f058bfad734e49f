// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FlatSolids.h"

#include "core/nodes/Boolean.h"
#include "core/nodes/Primitive.h"

#include <cstring>
#include <unordered_set>

namespace hybridtree
{
namespace
{

bool isFlatSolid(const Node& node)
{
  const auto* primitive = dynamic_cast<const Primitive*>(&node);
  return primitive && !primitive->isNegative() && primitive->potential().surfaceRadius() == 0.0 &&
    (primitive->skeleton().bounds().sizes().array() > 0.0).all();
}

class Walk
{
public:
  void visit(const Node& node, bool isCut)
  {
    if (!seen_[isCut].insert(&node).second)
    {
      return;
    }
    if (isCut && isFlatSolid(node))
    {
      kinds_.insert(static_cast<const Primitive&>(node).skeleton().kind());
    }
    const bool cuts = isCut || isCutting(node);
    for (const NodePtr& child : node.children())
    {
      this->visit(*child, cuts);
    }
  }

  const std::unordered_set<std::string>& kinds() const { return kinds_; }

private:
  static bool isCutting(const Node& node)
  {
    return std::strcmp(node.kind(), "boolean") == 0 &&
      node.parameters().getString("operation") != "union";
  }

  std::unordered_set<const Node*> seen_[2];
  std::unordered_set<std::string> kinds_;
};

} // namespace

std::vector<std::string> warningsOfFlatCuts(const std::vector<NodePtr>& children)
{
  Walk walk;
  for (const NodePtr& child : children)
  {
    walk.visit(*child, false);
  }
  std::vector<std::string> warnings;
  for (const std::string& kind : walk.kinds())
  {
    warnings.push_back("A Boolean below this blend cuts a solid (" + kind +
      ") of surface radius 0. The field of such a solid is as flat inside as at its surface, so "
      "the "
      "blend may lose what was cut away. Give the solid a surface radius above 0, or turn it into "
      "a mesh field.");
  }
  return warnings;
}

} // namespace hybridtree
