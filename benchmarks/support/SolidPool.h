// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshSide.h"
#include "core/mesh/TriangleMesh.h"

#include <memory>
#include <string>
#include <vector>

namespace hybridtree::benchmark
{

/// A mesh of the pool, of diagonal 2 about the origin, with its inside test.
struct Solid
{
  std::string name;
  TriangleMesh mesh;
  MeshBvh bvh;
  MeshSide side;

  Solid(std::string solidName, TriangleMesh solidMesh)
    : name(std::move(solidName)), mesh(std::move(solidMesh)), bvh(mesh), side(mesh, bvh)
  {
  }
  bool contains(const Vec3& p) const { return side.side(p) > 0; }
};

/// Solids to be put together at random.
using Pool = std::vector<std::unique_ptr<const Solid>>;

/// Reads a mesh in OFF. One that is open, no 2-manifold or (by CGAL) crosses itself is named and
/// left out.
void addToPool(const std::string& file, Pool& pool);

} // namespace hybridtree::benchmark
