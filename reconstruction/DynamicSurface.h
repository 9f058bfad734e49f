// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <utility>
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
/// About 1 KB is kept for each step, so that it can be taken back. May be copied. Not for several
/// threads at once.
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
    Prepared, ///< The surface has moved, so that it would take up the point now.
    Coincides ///< Nothing was done: it is a vertex of the surface.
  };
  enum class Way
  {
    Convected, ///< Only as the flow would: to points behind facets not oriented Gabriel.
    Any ///< Also to points that convection leaves behind: wherever it stays a manifold. Prepared
        ///< then is a step on the way, and may come many times.
  };
  /// \param near a site not far from the point: where its search starts.
  /// \param tolerance the point is left out if a triangle that it would replace is this near.
  Outcome place(const Vec3& point, std::int32_t near, double tolerance, Way way = Way::Convected);
  /// For Outcome::Near and Coincides of the last place(): a triangle that is, and its distance.
  std::int32_t nearTriangle() const { return nearTriangle_; }
  double nearDistance() const { return nearDistance_; }

  /// Steps are what place() did, from the last setInside on; the last can be taken back.
  std::size_t stepCount() const { return steps_.size(); }
  /// \returns whether that was a point placed, so that the last site is gone. \pre a step is left.
  bool undo();

  /// What the last step, or the last one undone, has done to the triangles. A triangle is the
  /// number of a half-facet, which changes where the tetrahedron behind it does.
  struct Change
  {
    std::vector<std::int32_t> removed;
    std::vector<std::int32_t> added;
    std::vector<std::pair<std::int32_t, std::int32_t>> renamed; // from, to
  };
  const Change& lastChange() const { return change_; }

  /// Triangles of the surface.
  std::vector<std::int32_t> surface() const;
  /// Sites of its corners, outward.
  Triangle triangle(std::int32_t number) const { return delaunay_.facet(number); }
  /// Above the numbers of all triangles.
  std::int32_t endOfNumbers() const { return 4 * delaunay_.cellCount(); }

private:
  struct Edge
  {
    std::int32_t from; // sites
    std::int32_t to;
  };
  // What a point to be added would replace.
  struct Hole
  {
    std::vector<Edge> edges; // of the border's facets whose cell is inside, each turned outward
    std::vector<std::int32_t> triangles; // of the surface within it
  };
  struct Step
  {
    std::int32_t flipped; // cell; -1: a point was placed
    std::size_t replaced; // where its part of the lists below begins
    std::size_t removed;
    std::size_t renamed;
  };

  Hole holeOf(const std::vector<std::int32_t>& cells);
  std::int32_t facetTowards(
    const Vec3& point, const std::vector<std::int32_t>& border, Way way) const;
  bool isNear(std::int32_t triangle, const Vec3& point, double tolerance);
  void remember(std::int32_t flipped);
  void fill(const Vec3& point, std::int32_t dent);
  Outcome surfaceAt(std::int32_t site, double tolerance, Way way);
  bool prepare(const Vec3& point, double tolerance, int moves);
  std::int32_t firstMove(const Vec3& point, double tolerance, int moves);
  bool mayPlace(const Vec3& point, double tolerance);
  bool approach(const std::vector<std::int32_t>& from);
  bool clear(const std::vector<std::int32_t>& cells);
  bool mayFlip(std::int32_t cell);
  int openFacets(std::int32_t cell) const;
  bool onSurface(std::int32_t site, std::int32_t other);
  void flip(std::int32_t cell);
  void takeBack(const Step& step);
  std::int32_t triangleOf(std::int32_t halfFacet) const;
  std::int32_t triangleAt(std::int32_t site) const;
  bool keepsManifold(const Hole& hole) const;

  Delaunay delaunay_;
  std::vector<std::uint8_t> inside_; // per cell
  Delaunay::Cavity cavity_;          // scratch
  std::vector<std::int32_t> star_;   // scratch
  std::vector<std::uint8_t> marks_;  // per cell; all 0 between uses
  std::int32_t nearTriangle_ = -1;
  double nearDistance_ = 0.0;
  Change change_;
  std::vector<Step> steps_;
  // Of all steps, one after the other.
  std::vector<Delaunay::Replaced> replaced_;
  std::vector<std::uint8_t> replacedInside_;
  std::vector<std::int32_t> removed_;
  std::vector<std::pair<std::int32_t, std::int32_t>> renamed_;
};

} // namespace hybridtree
