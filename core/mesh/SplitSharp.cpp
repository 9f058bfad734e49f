// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SplitSharp.h"

#include "core/base/DisjointSets.h"
#include "core/mesh/HalfEdges.h"

#include <cmath>

namespace hybridtree
{
namespace
{

class Splitter
{
public:
  Splitter(const TriangleMesh& mesh, double angle)
    : mesh_(mesh)
    , cosine_(std::cos(angle))
    , opposite_(halfEdges(mesh.triangles).opposite)
    , groups_(opposite_.size())
    , isSharp_(mesh.points.size(), 0)
  {
  }

  /// Whether any edge is sharp.
  bool find()
  {
    bool any = false;
    for (std::int32_t h = 0; h < std::int32_t(opposite_.size()); ++h)
    {
      const std::int32_t g = opposite_[std::size_t(h)];
      if (g < h)
      {
        continue; // seen from the other side, or no edge of two triangles
      }
      if (this->isSharp(h / 3, g / 3))
      {
        isSharp_[std::size_t(this->from(h))] = 1;
        isSharp_[std::size_t(this->from(next(h)))] = 1;
        any = true;
        continue;
      }
      const bool opposed = this->from(h) != this->from(g);
      groups_.join(std::uint32_t(h), std::uint32_t(opposed ? next(g) : g));
      groups_.join(std::uint32_t(next(h)), std::uint32_t(opposed ? g : next(g)));
    }
    return any;
  }

  TriangleMesh split()
  {
    TriangleMesh made = mesh_;
    std::vector<Vec3> sum(opposite_.size(), Vec3::Zero());   // per group
    std::vector<std::int32_t> pointOf(opposite_.size(), -1); // per group
    std::vector<char> isTaken(mesh_.points.size(), 0);       // by the first group of each point
    for (std::int32_t h = 0; h < std::int32_t(opposite_.size()); ++h)
    {
      const std::int32_t point = this->from(h);
      if (isSharp_[std::size_t(point)] == 0)
      {
        continue;
      }
      const std::size_t group = groups_.find(std::uint32_t(h));
      sum[group] += this->angleAt(h) * areaNormal(mesh_, std::size_t(h / 3)).stableNormalized();
      if (pointOf[group] < 0)
      {
        pointOf[group] = isTaken[std::size_t(point)] == 0 ? point : copyPoint(made, point);
        isTaken[std::size_t(point)] = 1;
      }
      made.triangles[std::size_t(h / 3)][std::size_t(h % 3)] = pointOf[group];
    }
    for (std::size_t group = 0; group < sum.size(); ++group)
    {
      const double length = sum[group].norm();
      if (pointOf[group] >= 0 && length > 0.0)
      {
        made.normals[std::size_t(pointOf[group])] = sum[group] / length;
      }
    }
    return made;
  }

private:
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  std::int32_t from(std::int32_t h) const
  {
    return mesh_.triangles[std::size_t(h / 3)][std::size_t(h % 3)];
  }

  // Triangles without area are on any side.
  bool isSharp(std::int32_t t, std::int32_t u) const
  {
    const Vec3 a = areaNormal(mesh_, std::size_t(t));
    const Vec3 b = areaNormal(mesh_, std::size_t(u));
    return a.dot(b) < cosine_ * a.norm() * b.norm();
  }

  double angleAt(std::int32_t h) const
  {
    const Vec3& p = mesh_.points[std::size_t(this->from(h))];
    const Vec3 a = mesh_.points[std::size_t(this->from(next(h)))] - p;
    const Vec3 b = mesh_.points[std::size_t(this->from(next(next(h))))] - p;
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  static std::int32_t copyPoint(TriangleMesh& mesh, std::int32_t point)
  {
    mesh.points.push_back(Vec3(mesh.points[std::size_t(point)]));
    mesh.normals.push_back(Vec3(mesh.normals[std::size_t(point)]));
    if (!mesh.vertexOrigin.empty())
    {
      mesh.vertexOrigin.push_back(VertexOrigin(mesh.vertexOrigin[std::size_t(point)]));
    }
    return std::int32_t(mesh.points.size()) - 1;
  }

  const TriangleMesh& mesh_;
  const double cosine_;
  const std::vector<std::int32_t> opposite_; // per half-edge, as everything by its first corner
  DisjointSets groups_;                      // of corners on one side
  std::vector<char> isSharp_;                // per point: of a sharp edge
};

} // namespace

MeshPtr splitAtSharpEdges(const MeshPtr& mesh, double angle)
{
  if (mesh->normals.empty())
  {
    return mesh;
  }
  Splitter splitter(*mesh, angle);
  return splitter.find() ? std::make_shared<const TriangleMesh>(splitter.split()) : mesh;
}

} // namespace hybridtree
