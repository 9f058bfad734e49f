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
    bool faceted = false; ///< its gradient jumps from facet to facet of a mesh
  };

  virtual ~IslandField() = default;

  /// The field in some boxes. Equal dependencies mean equal numbers at all points, to the last bit.
  virtual Near near(const std::vector<Box3>& boxes) const = 0;

  /// Fills sourceLeaf of an island. Told by the dependencies too.
  virtual void findSources(TriangleMesh& island, const Progress& progress) const = 0;
};

} // namespace hybridtree
