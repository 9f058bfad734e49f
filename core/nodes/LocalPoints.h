// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Scratch.h"

namespace hybridtree
{

/// Points in a leaf's own space: those given, or their images in scratch memory.
class LocalPoints
{
public:
  /// \param inverse to the leaf's own space; null for the identity.
  LocalPoints(PointBatch points, const Affine3* inverse)
    : scratch_(inverse ? points.size : 0), points_(inverse ? scratch_.points() : points)
  {
    if (inverse)
    {
      const VectorBatch local = scratch_.batch();
      for (std::size_t k = 0; k < points.size; ++k)
      {
        local.set(k, *inverse * points[k]);
      }
    }
  }
  operator PointBatch() const { return points_; }

private:
  ScratchVectors scratch_;
  PointBatch points_;
};

} // namespace hybridtree
