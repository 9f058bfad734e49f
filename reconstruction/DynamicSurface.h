// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <algorithm>
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
/// threads at once, but by hands.
class DynamicSurface
{
  struct Edge
  {
    std::int32_t from; // sites
    std::int32_t to;
    std::uint64_t key() const // the same both ways
    {
      const auto [low, high] = std::minmax(from, to);
      return std::uint64_t(low) << 32 | std::uint64_t(high);
    }
  };
  // What place() did, in a list.
  struct Step
  {
    std::int32_t flipped; // cell; -1: a point was placed
    std::int32_t site;    // which
    std::size_t replaced; // where its part of the lists below begins
    std::size_t removed;
    std::size_t renamed;
  };
  struct History
  {
    std::vector<Step> steps;
    // Of all steps, one after the other.
    std::vector<Delaunay::Replaced> replaced;
    std::vector<std::uint8_t> replacedInside;
    std::vector<std::int32_t> removed;
    std::vector<std::pair<std::int32_t, std::int32_t>> renamed;

    void append(const History& later);
    void forgetFrom(const Step& step);
  };

public:
  /// What a step has done to the triangles. A triangle is the number of a half-facet, which changes
  /// where the tetrahedron behind it does.
  struct Change
  {
    std::vector<std::int32_t> removed;
    std::vector<std::int32_t> added;
    std::vector<std::pair<std::int32_t, std::int32_t>> renamed; // from, to
  };

  /// Who places points one after the other. Several can at a time, each in a slab of space.
  class Hand
  {
  public:
    /// What its last step has done.
    const Change& lastChange() const { return change_; }
    /// For Outcome::Near and Coincides of its last place(): a triangle that is, and its distance.
    std::int32_t nearTriangle() const { return nearTriangle_; }
    double nearDistance() const { return nearDistance_; }
    /// The site of the last point it placed.
    std::int32_t lastSite() const { return history_.steps.back().site; }

  private:
    friend class DynamicSurface;
    Delaunay::Worker worker_;          // of several; else unused
    bool alone_ = true;                // the surface's own
    std::int32_t nextSite_ = 0;        // of several
    Delaunay::Cavity cavity_;          // scratch
    std::vector<std::int32_t> hole_;   // triangles within the cavity
    std::vector<std::uint8_t> inside_; // scratch
    std::vector<Edge> edges_;          // scratch
    std::vector<std::int32_t> sites_;  // scratch
    std::vector<std::int32_t> star_;   // scratch
    std::vector<std::uint8_t> marks_;  // per cell; all 0 between uses
    Change change_;
    std::int32_t nearTriangle_ = -1;
    double nearDistance_ = 0.0;
    History history_;
  };

  /// The points of the tetrahedralization, in the order they came in. Several hands may leave some
  /// between them that are unused.
  const std::vector<Vec3>& sites() const { return delaunay_.points(); }

  /// As Delaunay::limitCells().
  void limitTetrahedra(std::size_t most) { delaunay_.limitCells(most); }
  /// Adds points without regard to the surface. \throws Cancelled.
  void insert(const std::vector<Vec3>& points, const Progress& progress);
  /// Leaves out unused sites, and closes the gaps in their numbers. \pre setInside() comes next.
  void removeSites(const std::vector<std::uint8_t>& kept) { delaunay_.removePoints(kept); }

  /// Whether the sites are four at least, and not all in one plane.
  bool spansVolume() const { return delaunay_.spansVolume(); }

  /// What static convection works on. \pre sites() does not change as long as the result lives.
  /// \throws InvalidGeometry, Cancelled.
  Tetrahedralization tetrahedralization(const Progress& progress) const;

  /// Puts the surface around cells of tetrahedralization(), made since the last site came, and
  /// numbers its own cells as those.
  /// \param inside per cell, its boundary a closed 2-manifold.
  void setInside(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t> inside);

  enum class Outcome
  {
    Placed,    ///< The point is a vertex of the surface now.
    Near,      ///< Nothing was done: the surface is near enough to the point.
    Refused,   ///< Nothing was done: the surface is elsewhere, or would not stay a manifold.
    Surfaced,  ///< It was a site; now it is a vertex of the surface.
    Prepared,  ///< The surface has moved, so that it would take up the point now.
    Coincides, ///< Nothing was done: it is a vertex of the surface.
    Left       ///< Nothing was done: it is not for one of several hands alone.
  };
  enum class Way
  {
    Convected, ///< Only as the flow would: to points behind facets not oriented Gabriel.
    Any ///< Also to points that convection leaves behind: wherever it stays a manifold. Prepared
        ///< then is a step on the way, and may come many times.
  };
  /// \param triangle one not far from the point: where its search starts.
  /// \param tolerance the point is left out if a triangle that it would replace is this near.
  Outcome place(
    const Vec3& point, std::int32_t triangle, double tolerance, Way way = Way::Convected)
  {
    return this->place(own_, point, triangle, tolerance, way);
  }
  /// Who did that.
  const Hand& hand() const { return own_; }

  /// Hands that may place points, each by a thread of its own, until join(). In between, while all
  /// rest, the surface's own may too. What comes out does not depend on who is first.
  /// \param points where they will be placed: each hand gets as many.
  /// \param side across which of the sides of the box of all sites, 0 the longest.
  std::vector<Hand> part(const std::vector<Vec3>& points, int side);
  /// Which hand may replace a triangle; -1: only the surface's own.
  std::int32_t handOf(std::int32_t triangle) const { return delaunay_.slabOf(triangle) - 1; }
  /// To be called for each hand, before it may place at most so many points.
  void provide(Hand& hand, std::size_t points);
  /// \pre the hand may replace the triangle.
  /// \returns Placed, Near, Refused, Prepared or Left.
  Outcome place(Hand& hand, const Vec3& point, std::int32_t triangle, double tolerance)
  {
    return this->place(hand, point, triangle, tolerance, Way::Convected);
  }
  /// Puts the steps of a hand that rests after those before it.
  void gather(Hand& hand);
  void join(std::vector<Hand>& hands);

  /// Steps are what place() did, from the last setInside on; the last can be taken back.
  std::size_t stepCount() const { return own_.history_.steps.size(); }
  /// If it was a point placed, its site is gone, and those after it. \pre a step is left, no hands.
  void undo();
  /// What the last step, or the last one undone, has done to the triangles.
  const Change& lastChange() const { return own_.change_; }

  /// Triangles of the surface.
  std::vector<std::int32_t> surface() const;
  /// Sites of its corners, outward.
  Triangle triangle(std::int32_t number) const { return delaunay_.facet(number); }
  /// Above the numbers of all triangles.
  std::int32_t endOfNumbers() const { return 4 * delaunay_.cellCount(); }

private:
  Outcome place(Hand& hand, const Vec3& point, std::int32_t triangle, double tolerance, Way way);
  Delaunay::Place locate(Hand& hand, const Vec3& point, std::int32_t triangle);
  bool findCavity(Hand& hand, const Vec3& point, const Delaunay::Place& where);
  void findHole(Hand& hand) const;
  std::int32_t facetTowards(
    const Vec3& point, const std::vector<std::int32_t>& border, Way way) const;
  bool isNear(Hand& hand, std::int32_t triangle, const Vec3& point, double tolerance) const;
  static void remember(Hand& hand, std::int32_t flipped, std::int32_t site);
  void fill(Hand& hand, const Vec3& point, std::int32_t dent);
  void collectBases(
    const std::vector<std::int32_t>& star, std::vector<std::int32_t>& triangles) const;
  Outcome makeReady(Hand& hand, const Vec3& point, double tolerance, Way way);
  Outcome surfaceAt(std::int32_t site, double tolerance, Way way);
  bool prepare(Hand& hand, const Vec3& point, double tolerance, int moves);
  std::int32_t firstMove(Hand& hand, const Vec3& point, double tolerance, int moves);
  bool mayPlace(Hand& hand, const Vec3& point, double tolerance);
  bool approach(const std::vector<std::int32_t>& from);
  bool clear(const std::vector<std::int32_t>& cells);
  bool mayFlip(Hand& hand, std::int32_t cell) const;
  int openFacets(std::int32_t cell) const;
  bool vertexOnSurface(Hand& hand, std::int32_t cell, int vertex) const;
  bool edgeOnSurface(std::int32_t cell, int from, int to) const;
  void move(Hand& hand, std::int32_t cell);
  void flip(std::int32_t cell, Change& change);
  void takeBack(const Step& step);
  std::int32_t triangleOf(std::int32_t halfFacet) const;
  std::int32_t triangleAt(std::int32_t site) const;
  bool keepsManifold(Hand& hand) const;
  static bool isLoop(std::vector<Edge>& edges);

  Delaunay delaunay_;
  std::vector<std::uint8_t> inside_; // per cell
  Hand own_;
};

} // namespace hybridtree
