// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/CreaseLoops.h"
#include "core/polygonize/CreasePlanes.h"

#include <optional>

namespace hybridtree
{

/// A polygon of marching cubes and the walls of its cell, for finding a place on the crease that
/// crosses it.
class CreasePolygon
{
public:
  /// All must live as long as this. \param leastCosine between normals on two sides of a crease.
  CreasePolygon(
    const TriangleMesh& mesh, const Lattice& lattice, const CreaseLoop& loop, double leastCosine);

  std::size_t size() const { return loop_.corners.size(); }
  const Vec3& corner(std::size_t k) const { return mesh_.points[loop_.corners[k % this->size()]]; }
  /// Of the mesh there.
  const Vec3& meshNormal(std::size_t k) const
  {
    return mesh_.normals[loop_.corners[k % this->size()]];
  }
  Vec3 middle() const;
  double beyondCell(const Vec3& p) const { return cell_.exteriorDistance(p); }

  /// Of the field at the corners, one each. \pre called before what follows.
  void setNormals(std::vector<Vec3> normals) { normals_ = std::move(normals); }
  const std::vector<Vec3>& normals() const { return normals_; }

  /// Half way between where the crease comes into the cell and where it leaves it: so points follow
  /// one another along the crease as their cells do. Empty where it does not come and leave once
  /// through the polygon's sides. \param planes one for each corner.
  std::optional<Vec3> halfWay(const TouchingPlanes& planes) const;

  ///@{
  /// How far along the edge to go from the meeting point:
  /// to the middle of what lies within the cell, if anything does;
  double toMiddle(const Meeting& meeting) const;
  /// to the next place from which no side is seen the wrong way round, so that no triangle is
  /// turned over. Sides across the crease need not be seen if that cannot be: their triangles will
  /// be flipped.
  double toUpright(const Meeting& meeting) const;
  ///@}

private:
  bool isAcross(std::size_t k) const;
  std::optional<Vec3> passageAt(std::size_t k, const TouchingPlanes& planes) const;
  LinePart partUpright(const Meeting& meeting, bool all) const;

  const TriangleMesh& mesh_;
  const CreaseLoop& loop_;
  const double leastCosine_;
  const double size_; ///< of a cell
  Box3 cell_;
  std::vector<Vec3> normals_;
};

} // namespace hybridtree
