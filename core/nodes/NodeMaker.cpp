// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/NodeMaker.h"

#include "core/base/Error.h"

namespace hybridtree
{

void requireChildren(const char* kind, const std::vector<NodePtr>& children, std::size_t count)
{
  if (children.size() != count)
  {
    throw InvalidText("A node of kind \"" + std::string(kind) + "\" has " +
      std::to_string(children.size()) + " children; it must have " + std::to_string(count) + ".");
  }
}

} // namespace hybridtree
