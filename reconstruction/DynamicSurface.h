// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// A Delaunay tetrahedralization that points are added to, and a closed surface of its facets that
/// follows: geometric convection made dynamic ([HT] 3; Allegre, Chaine, Akkouche 2005).
///
/// A new point takes the place of the tetrahedra whose circumscribed balls hold it by a star of new
/// ones. Each new tetrahedron is inside where the old one at its base was. The surface changes but
/// within the star: its part there is replaced by a fan about the point. That part must be a disc,
/// bordered by one simple loop; then the surface stays a closed 2-manifold of the same genus. Where
/// no part of the surface is within, a facet at the border that is not oriented Gabriel for the
/// point is replaced by three, as in the flow of convection (and its opposite, outward).
/// Not for several threads at once.
class DynamicSurface
{
public:
  /// The points of the tetrahedralization, in the order they came in.
  const std::vector<Vec3>& sites() const { return delaunay_.points(); }

  /// Adds points without regard to the surface. \throws Cancelled.
  void insert(const std::vector<Vec3>& points, const Progress& progress);

  /// Whether the sites are four at least, and not all in one plane.
  bool spansVolume() const { return delaunay_.spansVolume(); }

  /// What static convection works on. \pre sites() does not change as long as the result lives.
  /// \throws InvalidGeometry, Cancelled.
  Tetrahedralization tetrahedralization(const Progress& progress) const;

  /// Puts the surface around cells of tetrahedralization(), made since the last site came.
  /// \param inside per cell, its boundary a closed 2-manifold.
  void setInside(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside);

  enum class Outcome
  {
    Placed,   ///< The point is a vertex of the surface now.
    Near,     ///< Nothing was done: the surface is near enough to the point.
    Refused,  ///< Nothing was done: the surface is elsewhere, or would not stay a manifold.
    Surfaced, ///< It was a site; now it is a vertex of the surface.
    Coincides ///< Nothing was done: it is a vertex of the surface.
  };
  /// \param near a site not far from the point: where its search starts.
  /// \param tolerance the point is left out if a triangle that it would replace is this near.
  Outcome place(const Vec3& point, std::int32_t near, double tolerance);
  /// For Outcome::Near of the last place(): the triangle, and its distance.
  const Triangle& nearTriangle() const { return nearTriangle_; }
  double nearDistance() const { return nearDistance_; }

  /// Corners of the triangles that place() has removed or made since the last call, in any order,
  /// some more than once.
  std::vector<std::int32_t> takeTouched();

  /// Triangles of the surface, indices into sites(), outward.
  std::vector<Triangle> surface() const;

private:
  struct Hole;
  Hole holeOf(const std::vector<std::int32_t>& cells);
  std::int32_t facetTowards(const Vec3& point, const std::vector<std::int32_t>& border) const;
  bool isNear(const Triangle& triangle, const Vec3& point, double tolerance);
  void fill(const Vec3& point, std::int32_t dent);
  Outcome surfaceAt(std::int32_t site, double tolerance);
  bool keepsManifold(const Hole& hole) const;

  Delaunay delaunay_;
  std::vector<std::uint8_t> inside_; // per cell
  Delaunay::Cavity cavity_;          // scratch
  std::vector<std::uint8_t> marks_;  // per cell; all 0 between uses
  Triangle nearTriangle_{ -1, -1, -1 };
  double nearDistance_ = 0.0;
  std::vector<std::int32_t> touched_;
};

} // namespace hybridtree
