// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <memory>

namespace hybridtree::benchmark
{

/// A Boolean of two meshes by somebody else's code.
class PeerBoolean
{
public:
  virtual ~PeerBoolean() = default;
  virtual const char* name() const = 0;

  /// Not to be timed: fresh operands, since some peers change theirs.
  virtual void prepare() = 0;
  /// False where the peer says that it could not. \pre prepare() before every call.
  virtual bool run(MeshOperation operation) = 0;
  /// Not to be timed. \pre run() returned true.
  virtual TriangleMesh result() const = 0;
};

/// CGAL::Polygon_mesh_processing::corefine_and_compute_union and the like, inexact constructions.
std::unique_ptr<PeerBoolean> cgalCorefinement(const TriangleMesh& a, const TriangleMesh& b);
std::unique_ptr<PeerBoolean> vtkLoopBoolean(const TriangleMesh& a, const TriangleMesh& b);
std::unique_ptr<PeerBoolean> vtkBooleanOperation(const TriangleMesh& a, const TriangleMesh& b);

/// By CGAL: whether a mesh crosses or touches itself.
bool crossesItself(const TriangleMesh& mesh);

} // namespace hybridtree::benchmark
