// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RemeshPoints.h"

namespace hybridtree
{
namespace
{

bool canMove(const RemeshSurface& surface, MeshLinks::Index p, const Vec3& target)
{
  bool good = true;
  surface.links().forEachLeaving(p,
    [&](MeshLinks::Index h)
    {
      const Vec3& b = surface.point(surface.links().to(h));
      const Vec3& c = surface.point(surface.links().opposite(h));
      good = good && !turnsTooFar(normalOf(surface.point(p), b, c), normalOf(target, b, c));
    });
  return good;
}

} // namespace

RemeshPoints::Index RemeshPoints::addMiddle(Index a, Index b)
{
  mesh_.points.push_back(0.5 * (mesh_.points[a] + mesh_.points[b]));
  if (!mesh_.normals.empty())
  {
    const Vec3 sum = mesh_.normals[a] + mesh_.normals[b];
    const double length = sum.norm();
    mesh_.normals.push_back(length > 0.0 ? Vec3(sum / length) : mesh_.normals[a]);
  }
  if (!mesh_.vertexOrigin.empty())
  {
    VertexOrigin origin;
    const VertexOrigin& from = mesh_.vertexOrigin[a];
    const VertexOrigin& to = mesh_.vertexOrigin[b];
    if (!project_ && from.leaf == to.leaf && from.triangle == to.triangle)
    {
      origin = { from.leaf, from.triangle, 0.5 * (from.u + to.u), 0.5 * (from.v + to.v) };
    }
    mesh_.vertexOrigin.push_back(origin);
  }
  const auto added = static_cast<Index>(mesh_.points.size() - 1);
  if (project_)
  {
    waiting_.push_back(added);
  }
  return added;
}

void RemeshPoints::project(RemeshSurface& surface)
{
  if (waiting_.empty())
  {
    return;
  }
  const bool hasNormals = !mesh_.normals.empty();
  std::vector<Vec3> points(waiting_.size());
  std::vector<Vec3> normals(waiting_.size(), Vec3::Zero());
  for (std::size_t k = 0; k < waiting_.size(); ++k)
  {
    points[k] = mesh_.points[waiting_[k]];
    normals[k] = hasNormals ? mesh_.normals[waiting_[k]] : normals[k];
  }
  project_(points, normals);
  std::size_t left = 0;
  for (std::size_t k = 0; k < waiting_.size(); ++k)
  {
    const Index p = waiting_[k];
    if (surface.links().isLocked(p)) // on a border, or collapsed
    {
      continue;
    }
    if (!points[k].allFinite() || !canMove(surface, p, points[k]))
    {
      waiting_[left++] = p;
      continue;
    }
    surface.movePoint(p, points[k]);
    if (hasNormals && normals[k].allFinite())
    {
      mesh_.normals[p] = normals[k];
    }
  }
  waiting_.resize(left);
}

} // namespace hybridtree
