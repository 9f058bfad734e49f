// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/IndexSet.h"
#include "core/mesh/MeshLinks.h"
#include "core/mesh/Remesh.h"
#include "core/mesh/RemeshShape.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// A mesh while it is remeshed: what the steps of remeshStretched share.
///
/// It knows the neighbourhood and the shape of each triangle, and which of them a step has to look
/// at: those of bad shape, those with a long edge, and those of which an edge may be flipped since
/// something about it has changed. So rounds cost what they change and not the size of the mesh.
/// Steps visit triangles in ascending order and see each other's changes; hence the result is that
/// of a look at every triangle in every round.
class RemeshSurface
{
public:
  using Index = MeshLinks::Index;

  /// \throws TooLarge, Cancelled.
  RemeshSurface(TriangleMesh& mesh, const RemeshOptions& options, const Progress& progress);

  double longSquared() const { return longSquared_; }
  double shortSquared() const { return shortSquared_; }

  const MeshLinks& links() const { return links_; }
  const Vec3& point(Index p) const { return mesh_.points[p]; }
  double squaredLength(Index h) const
  {
    return (this->point(links_.to(h)) - this->point(links_.from(h))).squaredNorm();
  }
  double shape(std::size_t t) const { return shapes_[t]; } ///< shapeOf()
  Vec3 normal(std::size_t t) const
  {
    const Triangle& c = links_.triangle(t);
    return normalOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
  }
  /// Of the triangle of a half-edge.
  std::int32_t leaf(Index h) const
  {
    return mesh_.sourceLeaf.empty() ? 0 : mesh_.sourceLeaf[h / 3];
  }

  ///@{
  /// Triangles: with a long edge; of bad shape; to be looked at for edges to flip, from which that
  /// step takes those that have none.
  const IndexSet& withLongEdge() const { return long_; }
  const IndexSet& bad() const { return bad_; }
  IndexSet& toFlip() { return toFlip_; }
  ///@}

  ///@{
  /// Edits are numbered from 1: the last of all, and the last that changed a triangle at a point.
  /// \pre the point is not locked.
  std::uint32_t lastEdit() const { return edit_; }
  std::uint32_t lastEditAt(Index p) const;
  ///@}

  ///@{
  /// Edits, as those of MeshLinks; the arrays per triangle follow. split() puts the point that
  /// comes next, which the mesh has to have.
  void split(Index h, Index middle);
  void flip(Index h);
  void collapse(Index h);
  /// \pre p is not locked.
  void movePoint(Index p, const Vec3& place);
  ///@}

  /// Now and then \throws Cancelled.
  void lookForStop(std::size_t step) const;

  /// Writes the triangles that are left back to the mesh.
  void pack();

private:
  void requireCountable() const;
  void measureAll();
  void measure(std::size_t t);
  void addHalf(Index h);
  void changeSource(Index h);
  void changed(std::size_t t);
  void look(std::size_t t);

  TriangleMesh& mesh_;
  const Progress& progress_;
  const double edgeLength_;
  const double longSquared_;
  const double shortSquared_;
  const double badShape_;
  MeshLinks links_;
  std::vector<double> shapes_;
  std::vector<std::uint32_t> edits_; ///< the last one that changed the triangle
  std::uint32_t edit_ = 0;
  IndexSet long_;
  IndexSet bad_;
  IndexSet touched_; ///< changed by an edit: flips may go on from there, whatever the shape
  IndexSet toFlip_;
};

} // namespace hybridtree
