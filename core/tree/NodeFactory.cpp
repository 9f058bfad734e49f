// SPDX-License-Identifier: BSD-3-Clause
#include "core/tree/NodeFactory.h"

#include "core/base/Error.h"
#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/nodes/SubdivisionSkeleton.h"

namespace hybridtree
{
namespace
{

struct Kind
{
  const char* name;
  NodeMaker make;
};

// One line per kind of node.
constexpr Kind kKinds[] = {
  { "primitive", primitiveFromParameters },
  { "subdivisionSkeleton", subdivisionSkeletonFromParameters },
  { "mesh", meshFromParameters },
  { "blend", blendFromParameters },
  { "localBlend", localBlendFromParameters },
  { "boolean", booleanFromParameters },
  { "twist", twistFromParameters },
  { "taper", taperFromParameters },
  { "bend", bendFromParameters },
  { "freeForm", freeFormFromParameters },
};

} // namespace

NodePtr makeNode(const std::string& kind, const Parameters& parameters,
  const std::vector<NodePtr>& children, const MeshLookup& lookup)
{
  for (const Kind& candidate : kKinds)
  {
    if (kind == candidate.name)
    {
      return candidate.make(parameters, children, lookup);
    }
  }
  throw InvalidText("\"" + kind + "\" is not a kind of node that this version knows.");
}

std::vector<std::string> nodeKinds()
{
  std::vector<std::string> names;
  for (const Kind& kind : kKinds)
  {
    names.emplace_back(kind.name);
  }
  return names;
}

} // namespace hybridtree
