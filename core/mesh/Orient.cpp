// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Orient.h"

#include "core/mesh/HalfEdges.h"
#include "core/mesh/SolidAngle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

struct Shell
{
  std::vector<std::int32_t> triangles;
  bool closed = false;
  bool oneSided = false;
  Box3 box;
};

class Orienter
{
public:
  explicit Orienter(TriangleMesh& mesh)
    : mesh_(mesh), halves_(halfEdges(mesh.triangles)), flip_(mesh.triangles.size(), kUnseen)
  {
  }

  Orientation run()
  {
    this->collectShells();
    for (Shell& shell : shells_)
    {
      this->settleShell(shell);
    }
    this->pointOutward();
    result_.openEdges = halves_.openEdges;
    result_.nonManifoldEdges = halves_.nonManifoldEdges;
    return result_;
  }

private:
  static constexpr std::int8_t kUnseen = -1;

  std::int32_t origin(std::int32_t half) const
  {
    return mesh_.triangles[std::size_t(half / 3)][std::size_t(half % 3)];
  }

  void collectShells()
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (flip_[t] == kUnseen)
      {
        shells_.push_back(this->flood(std::int32_t(t)));
      }
    }
  }

  // Everything reachable across edges of two triangles, with flip_ set relative to the first.
  Shell flood(std::int32_t first)
  {
    Shell shell;
    shell.closed = true;
    flip_[std::size_t(first)] = 0;
    shell.triangles.push_back(first);
    std::vector<std::pair<std::int32_t, std::int32_t>> heavyEdges;
    for (std::size_t next = 0; next < shell.triangles.size(); ++next)
    {
      const std::int32_t t = shell.triangles[next];
      for (std::int32_t half = 3 * t; half < 3 * t + 3; ++half)
      {
        const std::int32_t other = halves_.opposite[std::size_t(half)];
        if (other == HalfEdges::kNonManifold)
        {
          const Triangle& corner = mesh_.triangles[std::size_t(t)];
          heavyEdges.push_back(std::minmax<std::int32_t>(
            corner[std::size_t(half % 3)], corner[std::size_t((half + 1) % 3)]));
        }
        else if (other == HalfEdges::kOpen)
        {
          shell.closed = false;
        }
        else
        {
          const bool disagree = this->origin(half) == this->origin(other);
          const std::int8_t wanted = std::int8_t(flip_[std::size_t(t)] ^ std::int8_t(disagree));
          std::int8_t& flip = flip_[std::size_t(other / 3)];
          if (flip == kUnseen)
          {
            flip = wanted;
            shell.triangles.push_back(other / 3);
          }
          shell.oneSided = shell.oneSided || flip != wanted;
        }
      }
    }
    shell.closed = shell.closed && !shell.oneSided && pairsUp(heavyEdges);
    return shell;
  }

  // Shells that only touch along an edge are closed each: they use the edge an even number of
  // times.
  static bool pairsUp(std::vector<std::pair<std::int32_t, std::int32_t>>& edges)
  {
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
    {
      while (end < edges.size() && edges[end] == edges[begin])
      {
        ++end;
      }
      if ((end - begin) % 2 != 0)
      {
        return false;
      }
    }
    return true;
  }

  // Applies the flips of a shell, the fewer ones.
  void settleShell(Shell& shell)
  {
    std::size_t flips = 0;
    for (const std::int32_t t : shell.triangles)
    {
      flips += flip_[std::size_t(t)] == 1;
    }
    const std::int8_t turned = 2 * flips > shell.triangles.size() ? 0 : 1;
    for (const std::int32_t t : shell.triangles)
    {
      Triangle& corner = mesh_.triangles[std::size_t(t)];
      for (const std::int32_t vertex : corner)
      {
        shell.box.extend(mesh_.points[std::size_t(vertex)]);
      }
      if (flip_[std::size_t(t)] == turned && !shell.oneSided)
      {
        std::swap(corner[1], corner[2]);
        ++result_.flippedTriangles;
      }
    }
    result_.oneSidedShells += shell.oneSided;
  }

  double volume(const Shell& shell) const
  {
    const Vec3 center = shell.box.center();
    double sixfold = 0.0;
    for (const std::int32_t t : shell.triangles)
    {
      const Triangle& c = mesh_.triangles[std::size_t(t)];
      const auto at = [&](std::size_t k) -> Vec3
      { return mesh_.points[std::size_t(c[k])] - center; };
      sixfold += at(0).dot(at(1).cross(at(2)));
    }
    return sixfold / 6.0;
  }

  // Sum of solid angles around p, in turns.
  double winding(const Shell& shell, const Vec3& p) const
  {
    double sum = 0.0;
    for (const std::int32_t t : shell.triangles)
    {
      const Triangle& c = mesh_.triangles[std::size_t(t)];
      sum += solidAngle(mesh_.points[std::size_t(c[0])], mesh_.points[std::size_t(c[1])],
        mesh_.points[std::size_t(c[2])], p);
    }
    return sum / kFullSolidAngle;
  }

  // Tried at a few vertices, as one of them may lie on the other shell; the clearest answer counts.
  bool contains(const Shell& outer, const Shell& inner) const
  {
    constexpr std::size_t tries = 5;
    double clearest = 1.0;
    bool inside = false;
    for (std::size_t k = 0; k < tries && clearest > 1e-6; ++k)
    {
      const std::size_t pick = k * (inner.triangles.size() - 1) / (tries - 1);
      const Triangle& c = mesh_.triangles[std::size_t(inner.triangles[pick])];
      const double turns = this->winding(outer, mesh_.points[std::size_t(c[k % 3])]);
      const double doubt = std::abs(turns - std::round(turns));
      if (doubt < clearest)
      {
        clearest = doubt;
        inside = std::abs(turns) > 0.5;
      }
    }
    return inside;
  }

  void pointOutward()
  {
    std::vector<const Shell*> closed;
    for (const Shell& shell : shells_)
    {
      if (shell.closed)
      {
        closed.push_back(&shell);
      }
    }
    for (const Shell* shell : closed)
    {
      bool cavity = false;
      for (const Shell* other : closed)
      {
        if (other != shell && other->box.contains(shell->box))
        {
          cavity = cavity != this->contains(*other, *shell);
        }
      }
      result_.cavities += cavity;
      if ((this->volume(*shell) < 0.0) != cavity)
      {
        ++result_.flippedShells;
        for (const std::int32_t t : shell->triangles)
        {
          std::swap(mesh_.triangles[std::size_t(t)][1], mesh_.triangles[std::size_t(t)][2]);
        }
      }
    }
  }

  TriangleMesh& mesh_;
  HalfEdges halves_;
  std::vector<std::int8_t> flip_; // relative to the first triangle of its shell
  std::vector<Shell> shells_;
  Orientation result_;
};

} // namespace

Orientation orientTriangles(TriangleMesh& mesh)
{
  return Orienter(mesh).run();
}

} // namespace hybridtree
