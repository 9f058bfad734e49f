// SPDX-License-Identifier: BSD-3-Clause
// Private: the box that frames and lattices are fitted to.
#ifndef vtkHybridTreeBounds_h
#define vtkHybridTreeBounds_h

#include "core/nodes/Node.h"

namespace hybridtree
{

/// Bounds of the surface; of the influence for a shape without surface (a negative one); a unit box
/// for one that is nowhere.
inline Box3 boundsToFit(const Node& node)
{
  for (const Box3& box : { node.surfaceBounds(), node.influenceBounds() })
  {
    if (!box.isEmpty() && box.sizes().maxCoeff() > 0.0)
    {
      return box;
    }
  }
  return Box3(Vec3::Constant(-0.5), Vec3::Constant(0.5));
}

} // namespace hybridtree

#endif
