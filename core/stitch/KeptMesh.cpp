// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/KeptMesh.h"

#include "core/base/Parallel.h"
#include "core/mesh/PerMesh.h"
#include "core/stitch/CheckPatch.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 8192;

bool indicesAreInRange(const TriangleMesh& mesh)
{
  const auto size = static_cast<std::int32_t>(mesh.points.size());
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
    [size](const Triangle& c) {
      return std::min({ c[0], c[1], c[2] }) >= 0 && std::max({ c[0], c[1], c[2] }) < size;
    });
}

/// Whether the triangles at every point that has any are one closed fan: then the mesh is a closed,
/// oriented 2-manifold.
bool areFansClosed(const TriangleMesh& mesh, const PointTriangles& triangles)
{
  std::atomic<bool> good{ true };
  parallelFor(mesh.points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<FanSide> fan;
      for (auto v = static_cast<std::int32_t>(begin); good && v < static_cast<std::int32_t>(end);
           ++v)
      {
        fan.clear();
        for (std::int32_t k = 0; k < triangles.count(v); ++k)
        {
          const Triangle& c = mesh.triangles[triangles.of(v)[k]];
          const int at = c[0] == v ? 0 : c[1] == v ? 1 : 2;
          fan.push_back({ v, c[(at + 1) % 3], c[(at + 2) % 3] });
        }
        if (!fan.empty() && !isClosedFan(fan.data(), fan.data() + fan.size()))
        {
          good = false;
        }
      }
    });
  return good;
}

constexpr double kCreaseCosine = 0.866;

/// Of those sides of a triangle that it shares with one of a higher number.
double creaseLengthAt(const TriangleMesh& mesh, const PointTriangles& triangles, std::size_t t)
{
  const Triangle& corners = mesh.triangles[t];
  const Vec3 normal = areaNormal(mesh, t);
  double length = 0.0;
  for (int side = 0; side < 3; ++side)
  {
    std::int32_t a = corners[side];
    std::int32_t b = corners[(side + 1) % 3];
    if (triangles.count(b) < triangles.count(a))
    {
      std::swap(a, b); // the tip of a cone may have all triangles around it
    }
    const std::int32_t* const begin = triangles.of(a);
    for (const std::int32_t* other = begin; other != begin + triangles.count(a); ++other)
    {
      const auto n = static_cast<std::size_t>(*other);
      const Triangle& c = mesh.triangles[n];
      if (n > t && std::find(c.begin(), c.end(), b) != c.end())
      {
        const Vec3 beyond = areaNormal(mesh, n);
        const bool isSharp = normal.dot(beyond) < kCreaseCosine * normal.norm() * beyond.norm();
        length += isSharp ? (mesh.points[a] - mesh.points[b]).norm() : 0.0;
      }
    }
  }
  return length;
}

} // namespace

PointTriangles::PointTriangles(const TriangleMesh& mesh)
  : begin_(mesh.points.size() + 1, 0), triangles_(3 * mesh.triangles.size())
{
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t v : triangle)
    {
      ++begin_[v + 1];
    }
  }
  for (std::size_t v = 1; v < begin_.size(); ++v)
  {
    if (begin_[v] == 0)
    {
      unused_.push_back(static_cast<std::int32_t>(v - 1));
    }
    begin_[v] += begin_[v - 1];
  }
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t v : mesh.triangles[t])
    {
      triangles_[static_cast<std::size_t>(next[v]++)] = static_cast<std::int32_t>(t);
    }
  }
}

std::shared_ptr<const KeptMesh> KeptMesh::of(const MeshPtr& mesh)
{
  static PerMesh<KeptMesh> known;
  return known.of(
    mesh, [](const TriangleMesh& object) { return std::make_shared<const KeptMesh>(object); });
}

bool KeptMesh::isSound() const
{
  std::call_once(soundOnce_,
    [&]
    {
      sound_ = mesh_.normals.size() == mesh_.points.size() && indicesAreInRange(mesh_) &&
        areFansClosed(mesh_, this->pointTriangles());
    });
  return sound_;
}

double KeptMesh::area() const
{
  std::call_once(areaOnce_,
    [&]
    {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      {
        area_ += 0.5 * areaNormal(mesh_, t).norm();
      }
    });
  return area_;
}

double KeptMesh::creaseLength() const
{
  std::call_once(creasesOnce_,
    [&]
    {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      {
        creaseLength_ += creaseLengthAt(mesh_, this->pointTriangles(), t);
      }
    });
  return creaseLength_;
}

Box3 KeptMesh::bounds() const
{
  std::call_once(boundsOnce_, [&] { bounds_ = mesh_.bounds(); });
  return bounds_;
}

const PointTriangles& KeptMesh::pointTriangles() const
{
  std::call_once(trianglesOnce_, [&] { triangles_.emplace(mesh_); });
  return *triangles_;
}

const TriangleBlocks& KeptMesh::blocks() const
{
  // Islands ask for it all at once: the others wait for the first.
  std::call_once(blocksOnce_, [&] { blocks_.emplace(mesh_); });
  return *blocks_;
}

} // namespace hybridtree
