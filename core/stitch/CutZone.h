// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "core/stitch/KeptMesh.h"

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hybridtree
{

/// Large triangles at a cut, which are to be triangulated anew together: at first the cut ones with
/// a side of more than two cells.
class CutZone
{
public:
  using Index = std::int32_t;
  using Side = std::pair<Index, Index>; ///< two points of the mesh

  /// Whether a side counts as large. Where none at the cells is, the cut depends on nothing else.
  static bool isLarge(double length, double cellSize) { return length > kLarge * cellSize; }

  CutZone(const TriangleMesh& mesh, const KeptMesh& known, const CutMesh& cut, double cellSize);

  /// Cut ones first.
  const std::vector<Index>& triangles() const { return triangles_; }
  std::size_t cutTriangles() const { return cutTriangles_; }
  /// Place of a triangle in these; -1.
  Index placeOf(Index triangle) const;

  /// Adds the triangles beyond large sides, as they run in triangles of the zone, and on from there
  /// those beyond sides that are twice as long as they are far from the cut: along them it would be
  /// the same. \return whether there are any; not when there are too many.
  bool growBeyond(const std::vector<Side>& sides);
  /// Takes the last ones away again. \param count of those that stay.
  void shrink(std::size_t count);

  /// Per triangle: those of one facet lie in one plane and are joined. That is so where points are
  /// within single precision of the plane, relative to the largest coordinate, as which exactly
  /// flat faces are stored.
  const std::vector<Index>& facets() const { return facets_; }
  const std::vector<Vec3>& normals() const { return normals_; } ///< per facet, unit length
  void findFacets();

private:
  static constexpr double kLarge = 2.0; // cells

  const Vec3& corner(Index t, int k) const { return mesh_.points[mesh_.triangles[t][k % 3]]; }
  bool isLarge(const Vec3& a, const Vec3& b) const;
  void add(Index t);
  bool addBeyond(Index from, Index to);
  void findLine();
  bool isNearForItsLength(const Vec3& a, const Vec3& b) const;
  Index owner(Index from, Index to) const;
  void collectFacet(Index seed, double most);

  const TriangleMesh& mesh_;
  const PointTriangles& around_;
  const CutMesh& cut_;
  const double cellSize_;
  std::vector<Vec3> line_; ///< points along which the mesh was cut
  std::vector<Index> triangles_;
  std::size_t cutTriangles_ = 0;
  std::unordered_map<Index, Index> place_;
  std::vector<Index> facets_;
  std::vector<Vec3> normals_;
};

} // namespace hybridtree
