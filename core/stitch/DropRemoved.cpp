// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/DropRemoved.h"

namespace hybridtree
{
namespace
{

void takeTriangles(const MeshLinks& links, const std::vector<bool>& touched, TriangleMesh& mesh)
{
  std::size_t kept = 0;
  for (std::size_t t = 0; t < links.triangleCount(); ++t)
  {
    if (links.isRemoved(t))
    {
      continue;
    }
    mesh.triangles[kept] = links.triangle(t);
    mesh.sourceLeaf[kept] = mesh.sourceLeaf[t];
    if (!mesh.sourceTriangle.empty())
    {
      mesh.sourceTriangle[kept] = touched[t] ? -1 : mesh.sourceTriangle[t];
    }
    ++kept;
  }
  mesh.triangles.resize(kept);
  mesh.sourceLeaf.resize(kept);
  mesh.sourceTriangle.resize(mesh.sourceTriangle.empty() ? 0 : kept);
}

std::vector<bool> usedPoints(const TriangleMesh& mesh, std::size_t keptPoints)
{
  std::vector<bool> used(mesh.points.size(), false);
  for (std::size_t v = 0; v < keptPoints; ++v)
  {
    used[v] = true;
  }
  for (const Triangle& corners : mesh.triangles)
  {
    for (const std::int32_t v : corners)
    {
      used[static_cast<std::size_t>(v)] = true;
    }
  }
  return used;
}

} // namespace

void dropRemoved(const MeshLinks& links, const std::vector<bool>& touched, std::size_t keptPoints,
  TriangleMesh& mesh, std::vector<bool>& onCrease)
{
  takeTriangles(links, touched, mesh);
  const std::vector<bool> used = usedPoints(mesh, keptPoints);
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::size_t next = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
  {
    if (!used[v])
    {
      continue;
    }
    onCrease[next] = onCrease[v];
    mesh.points[next] = mesh.points[v];
    mesh.normals[next] = mesh.normals[v];
    if (!mesh.vertexOrigin.empty())
    {
      mesh.vertexOrigin[next] = mesh.vertexOrigin[v];
    }
    number[v] = static_cast<std::int32_t>(next++);
  }
  mesh.points.resize(next);
  mesh.normals.resize(next);
  onCrease.resize(next);
  mesh.vertexOrigin.resize(mesh.vertexOrigin.empty() ? 0 : next);
  for (Triangle& corners : mesh.triangles)
  {
    for (std::int32_t& v : corners)
    {
      v = number[static_cast<std::size_t>(v)];
    }
  }
}

} // namespace hybridtree
