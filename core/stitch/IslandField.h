// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Dependency.h"
#include "core/base/Progress.h"
#include "core/base/Types.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// A field as the islands of marked cells ask for it: each for what reaches it, so that it can be
/// told from the dependencies alone whether an island would come out the same.
class IslandField
{
public:
  struct Near
  {
    FieldSourcePtr source; ///< not null; lives no longer than the field
    std::vector<Dependency> dependencies;
  };

  virtual ~IslandField() = default;

  /// The field in a box. Equal dependencies mean equal numbers at all points, to the last bit.
  virtual Near near(const Box3& box) const = 0;

  /// Last touches to the new triangles of an island: normals of its points from `keptPoints` on,
  /// and sourceLeaf. Told by the dependencies too.
  virtual void finish(
    TriangleMesh& island, std::size_t keptPoints, const Progress& progress) const = 0;
};

} // namespace hybridtree
