// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// Neighbourhood of a triangle mesh, kept up while edges are split, flipped and collapsed.
///
/// Half-edge h = 3 t + k is the side of triangle t that starts at its corner k. Where the mesh is
/// not an oriented 2-manifold half-edges have no twin, and the points there are locked: they keep
/// their triangles. A removed triangle has corners -1.
class MeshLinks
{
public:
  using Index = std::int32_t;
  static constexpr Index kNone = -1;

  MeshLinks(const std::vector<Triangle>& triangles, std::size_t points);

  std::size_t triangleCount() const { return triangles_.size(); }
  const Triangle& triangle(std::size_t t) const { return triangles_[t]; }
  bool isRemoved(std::size_t t) const { return triangles_[t][0] == kNone; }

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return triangles_[h / 3][h % 3]; }
  Index to(Index h) const { return this->from(next(h)); }
  Index opposite(Index h) const { return this->from(previous(h)); }
  Index twin(Index h) const { return twins_[h]; }

  /// On a border, or where the triangles form no single fan.
  bool isLocked(Index point) const { return locked_[point] != 0; }

  /// Calls visit(h) for the half-edges that leave a point. \pre it is not locked.
  template <class Visit>
  void forEachLeaving(Index point, Visit&& visit) const
  {
    const Index first = leaving_[point];
    Index h = first;
    do
    {
      visit(h);
      h = twins_[previous(h)];
    } while (h != first);
  }

  /// \pre not both locked; two locked points count as joined.
  bool areJoined(Index a, Index b) const;

  /// Puts `middle`, the next point, on an edge. The triangles of the edge keep the half from its
  /// start; the other halves are new triangles at the end of the list, that of h's triangle first.
  void split(Index h, Index middle);

  /// \pre canFlip(h).
  void flip(Index h);
  bool canFlip(Index h) const;

  /// Merges the start of h into its end. \pre canCollapse(h).
  void collapse(Index h);
  /// Keeps the surface a manifold of the same genus (link condition, Dey et al. 1999).
  bool canCollapse(Index h) const;

private:
  void lockPoints();
  Index valence(Index point) const;
  void join(Index a, Index b);
  void splitTriangle(Index h, Index middle);

  std::vector<Triangle> triangles_;
  std::vector<Index> twins_;
  std::vector<Index> leaving_; ///< one half-edge from each point
  std::vector<char> locked_;   ///< one byte each, for threads
};

} // namespace hybridtree
