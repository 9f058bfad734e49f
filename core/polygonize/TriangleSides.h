// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// A side of a triangle of a mesh.
struct TriangleSide
{
  std::int32_t from;
  std::int32_t to;
  std::size_t triangle;
};

/// The sides of some triangles, to be found by their ends.
class TriangleSides
{
public:
  void clear() { sides_.clear(); }
  void add(const TriangleMesh& mesh, std::size_t triangle);
  /// To be called once all are there. \pre for all that follows.
  void sort();

  /// By rising `from`, then `to`.
  const std::vector<TriangleSide>& all() const { return sides_; }
  /// One with these ends, or null.
  const TriangleSide* find(std::int32_t from, std::int32_t to) const;
  const TriangleSide* twinOf(const TriangleSide& side) const
  {
    return this->find(side.to, side.from);
  }
  /// Whether a side that begins there has no twin.
  bool isOpenAt(std::int32_t point) const;

private:
  std::vector<TriangleSide> sides_;
};

/// The corner that is not on a side.
std::int32_t cornerOpposite(const TriangleMesh& mesh, const TriangleSide& side);

/// Takes triangles out of a mesh; the others keep their order, sourceLeaf and sourceTriangle.
/// Triangles beyond those that have these arrays get -1.
/// \param removed per triangle; those beyond its end stay.
void dropTriangles(TriangleMesh& mesh, const std::vector<bool>& removed);

} // namespace hybridtree
