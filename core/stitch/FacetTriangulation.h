// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/stitch/SideTable.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Triangulated flat polygons in space that share sides: facets.
struct FacetMesh
{
  std::vector<Vec3> points;
  std::vector<Triangle> triangles; ///< counter-clockwise about the normal of their facet
  std::vector<std::int32_t> facet; ///< per triangle
  std::vector<Vec3> normals;       ///< per facet, unit length
};

/// Facets whose triangulations can be made Delaunay, and get more points.
///
/// A side is free between two triangles of a facet, a crease between two facets, and otherwise
/// fixed: at the border of all, where three meet, and at facets with a triangle that is turned over
/// by rounding, which stay as they are. New points lie in the plane of their facet, or on a crease,
/// which they split on both sides at once.
class FacetTriangulation
{
public:
  using Index = std::int32_t;
  static constexpr Index kNone = SideTable::kNone;

  struct Side
  {
    Index from;
    Index to;
  };
  enum class Kind
  {
    Free,
    Crease,
    Fixed
  };

  /// What a point would replace: triangles whose circles it lies in, and the sides around them.
  struct Cavity
  {
    std::vector<Index> triangles;
    std::vector<Side> border;
    bool good = false; ///< the point sees all of the border from inside
  };

  explicit FacetTriangulation(FacetMesh mesh);

  /// Flips free sides until no circle around a triangle has a point of its facet inside.
  void flipAll();

  std::size_t triangleCount() const { return mesh_.triangles.size(); }
  std::size_t pointCount() const { return mesh_.points.size(); }
  const Triangle& triangle(Index t) const { return mesh_.triangles[t]; }
  const Vec3& point(Index v) const { return mesh_.points[v]; }
  const Vec3& normal(Index t) const { return mesh_.normals[mesh_.facet[t]]; }
  bool isFrozen(Index t) const { return frozen_[mesh_.facet[t]]; }

  /// Cosine of a triangle's smallest angle.
  double shape(Index t) const;
  Kind kind(const Side& side) const;
  /// The triangle on the left of a side; kNone.
  Index owner(const Side& side) const { return owner_.find(side.from, side.to); }
  /// Twice the area of a, b, p in the plane of a triangle.
  double area(Index t, Index a, Index b, const Vec3& p) const;

  /// \param t contains p.
  Cavity cavityOf(const Vec3& p, Index t) const;
  /// Of a point on a side of t, which is not in the border.
  Cavity cavityOf(const Vec3& p, const Side& side) const;

  /// Puts a point in. \return its number. \pre the cavity is good, of this point and as it is now.
  Index insert(const Vec3& p, const Cavity& cavity, std::vector<Index>& changed);
  /// The same on a crease, of both facets.
  Index insert(const Vec3& p, const Cavity& left, const Cavity& right, std::vector<Index>& changed);

  FacetMesh take() { return std::move(mesh_); }

private:
  void link(Index t);
  void unlink(Index t);
  void freeze();
  bool flip(const Side& side, std::vector<Side>& waiting);
  bool isInCircle(const Vec3& p, Index t) const;
  void grow(const Vec3& p, const Side* without, Cavity& cavity) const;
  void fill(Index v, const Cavity& cavity, std::vector<Index>& changed);

  FacetMesh mesh_;
  SideTable owner_;          ///< of a side, counter-clockwise
  std::vector<bool> frozen_; ///< per facet
};

} // namespace hybridtree
