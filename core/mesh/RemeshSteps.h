// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/RemeshPoints.h"
#include "core/mesh/RemeshSurface.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

// The steps of a round of remeshStretched, each in a file of its own. All return whether they have
// changed anything and may throw Cancelled.

/// Splits edges until none is longer than 4/3 L, in passes that bring the new points onto the
/// surface.
bool splitLongEdges(RemeshSurface& surface, RemeshPoints& points, const Progress& progress);

/// Collapses the shortest edge of each badly shaped triangle where it is short, and the worst shape
/// around gets better by it. What has been refused is not asked again until something at one of its
/// ends has changed.
class ShortEdges
{
public:
  explicit ShortEdges(RemeshSurface& surface) : surface_(surface) {}

  bool collapse();

private:
  using Index = RemeshSurface::Index;

  bool collapse(std::size_t t);

  RemeshSurface& surface_;
  std::vector<std::uint32_t> refused_; ///< per triangle, after which edit
};

/// Flips edges of badly shaped and changed triangles where that makes the smallest angle larger.
bool flipEdges(RemeshSurface& surface);

} // namespace hybridtree
