// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Dust.h"

#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

std::int32_t rootOf(std::vector<std::int32_t>& parent, std::int32_t point)
{
  while (parent[point] != point)
  {
    parent[point] = parent[parent[point]];
    point = parent[point];
  }
  return point;
}

// For each point the least point of its component.
std::vector<std::int32_t> componentsOf(const TriangleMesh& mesh)
{
  std::vector<std::int32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Triangle& corner : mesh.triangles)
  {
    for (int k = 1; k < 3; ++k)
    {
      const std::int32_t a = rootOf(parent, corner[0]);
      const std::int32_t b = rootOf(parent, corner[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t p = 0; p < parent.size(); ++p)
  {
    parent[p] = rootOf(parent, static_cast<std::int32_t>(p));
  }
  return parent;
}

// By the least point of each component: whether it is dust.
std::vector<bool> dustOf(
  const TriangleMesh& mesh, const std::vector<std::int32_t>& component, double thickness)
{
  std::vector<double> volume(mesh.points.size(), 0.0);
  std::vector<double> area(mesh.points.size(), 0.0);
  for (const Triangle& corner : mesh.triangles)
  {
    const std::int32_t owner = component[corner[0]];
    const Vec3& origin = mesh.points[owner]; // near: volumes keep their digits
    const Vec3 a = mesh.points[corner[0]] - origin;
    const Vec3 b = mesh.points[corner[1]] - origin;
    const Vec3 c = mesh.points[corner[2]] - origin;
    volume[owner] += a.dot(b.cross(c)) / 6.0;
    area[owner] += (b - a).cross(c - a).norm() / 2.0;
  }
  std::vector<bool> dust(mesh.points.size());
  for (std::size_t p = 0; p < dust.size(); ++p)
  {
    dust[p] = std::abs(volume[p]) <= thickness * area[p];
  }
  return dust;
}

} // namespace

void dropDust(TriangleMesh& mesh, double thickness)
{
  const std::vector<std::int32_t> component = componentsOf(mesh);
  const std::vector<bool> dust = dustOf(mesh, component, thickness);
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::size_t points = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    if (dust[component[p]])
    {
      continue;
    }
    number[p] = static_cast<std::int32_t>(points);
    mesh.points[points] = mesh.points[p];
    if (!mesh.normals.empty())
    {
      mesh.normals[points] = mesh.normals[p];
    }
    ++points;
  }
  std::size_t triangles = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& corner = mesh.triangles[t];
    if (number[corner[0]] < 0)
    {
      continue;
    }
    mesh.triangles[triangles] = { number[corner[0]], number[corner[1]], number[corner[2]] };
    if (!mesh.sourceLeaf.empty())
    {
      mesh.sourceLeaf[triangles] = mesh.sourceLeaf[t];
    }
    ++triangles;
  }
  mesh.points.resize(points);
  mesh.normals.resize(mesh.normals.empty() ? 0 : points);
  mesh.triangles.resize(triangles);
  mesh.sourceLeaf.resize(mesh.sourceLeaf.empty() ? 0 : triangles);
}

} // namespace hybridtree
