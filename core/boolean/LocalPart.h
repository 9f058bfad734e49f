// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshLinks.h"
#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// Some triangles of a mesh with points numbered anew, so that links over them are small.
struct LocalPart
{
  explicit LocalPart(const std::vector<Triangle>& part);

  /// The triangles as the links have them, in points of the mesh; -1 for those that are gone.
  void write(const MeshLinks& links, std::vector<Triangle>& part) const;

  std::vector<std::int32_t> pointOf; ///< of the mesh, per point of the part
  std::vector<Triangle> triangles;   ///< in points of the part
};

} // namespace hybridtree
