// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/RemeshSurface.h"

#include <vector>

namespace hybridtree
{

/// New points of a mesh that is remeshed: they begin in the middle of edges and are brought onto
/// the surface from there.
class RemeshPoints
{
public:
  using Index = MeshLinks::Index;

  /// \param project may be null: points then stay where they begin.
  RemeshPoints(TriangleMesh& mesh, const ProjectToSurface& project) : mesh_(mesh), project_(project)
  {
  }

  /// A point in the middle between two, with what points have interpolated.
  Index addMiddle(Index a, Index b);

  /// Moves the new points onto the surface, unless a triangle there would turn too far: those wait
  /// on, for better triangles.
  void project(RemeshSurface& surface);

private:
  TriangleMesh& mesh_;
  const ProjectToSurface& project_;
  std::vector<Index> waiting_; ///< not on the surface yet
};

} // namespace hybridtree
