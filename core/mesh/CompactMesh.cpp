// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/CompactMesh.h"

namespace hybridtree
{
namespace
{

/// An array that the mesh does not have stays empty.
template <class T>
void keepMarked(std::vector<T>& array, const std::vector<bool>& keep)
{
  if (array.empty())
  {
    return;
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < keep.size(); ++k)
  {
    if (keep[k])
    {
      array[kept++] = array[k];
    }
  }
  array.resize(kept);
}

} // namespace

void keepTriangles(TriangleMesh& mesh, const std::vector<bool>& keep)
{
  keepMarked(mesh.triangles, keep);
  keepMarked(mesh.sourceLeaf, keep);
  keepMarked(mesh.sourceTriangle, keep);
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t p : triangle)
    {
      used[std::size_t(p)] = true;
    }
  }
  keepMarked(mesh.points, used);
  keepMarked(mesh.normals, used);
  keepMarked(mesh.vertexOrigin, used);
  std::vector<std::int32_t> place(used.size(), -1);
  std::int32_t next = 0;
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    place[p] = used[p] ? next++ : -1;
  }
  for (Triangle& triangle : mesh.triangles)
  {
    for (std::int32_t& p : triangle)
    {
      p = place[std::size_t(p)];
    }
  }
}

} // namespace hybridtree
