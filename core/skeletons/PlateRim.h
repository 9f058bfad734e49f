// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/PlanarTriangulation.h"

#include <vector>

namespace hybridtree
{

/// The curves around an outline at a distance outside of it: its sides moved outward, arcs around
/// convex corners, mitres at reflex ones. Cut at the sharper corners into chains, so that points
/// stand there, in the middle of arcs and on the mitres, at every distance.
class PlateRim
{
public:
  /// \pre counter-clockwise and simple.
  explicit PlateRim(const std::vector<Vec2>& corners);

  /// Whether the curves at `distance` and nearer do not meet themselves.
  bool isSimple(double distance) const;

  /// Length of the outline itself.
  double length() const;

  /// A point of a curve: its place is foot + distance * outward.
  struct Point
  {
    Vec2 foot;
    Vec2 outward; ///< a unit vector, longer on a mitre
    Vec2 normal;  ///< of the outline's plane; shorter than 1 on a mitre, as the mean of two
  };
  /// Where something is on its chain: along the sides, and turned around corners. Both increase.
  struct Place
  {
    double along = 0.0;
    double angle = 0.0;
  };
  /// Between two breaks.
  struct Chain
  {
    std::vector<Point> points;  ///< both ends included: the last is the first of the next chain
    std::vector<Place> middles; ///< of the edges between them
    Place end;
  };
  using Ring = std::vector<Chain>;

  /// The outline: `counts` edges on each side.
  Ring outline(const std::vector<int>& counts) const;
  /// The curve at a distance > 0, in even edges of at most `spacing`.
  Ring curve(double distance, double spacing) const;

private:
  struct Corner
  {
    Vec2 place;
    double turn;  // exterior angle, < 0 at reflex corners
    double mitre; // by which the sides at a reflex corner get shorter per distance
    Vec2 bisector;
    bool isBreak;
  };
  struct Side
  {
    Vec2 direction;
    Vec2 normal;
    double length;
  };

  int after(int corner) const;
  int nextBreak(int corner) const;
  void chooseBreaks();
  double startOf(int side, double distance) const;
  double endOf(int side, double distance) const;
  Point onSide(int side, double at) const;
  Point onArc(int corner, double share) const;
  Point onMitre(int corner) const;
  Chain chain(int first, double distance, double spacing) const;
  bool sideIsClear(int side, double distance) const;
  bool arcIsClear(int corner, double distance) const;

  std::vector<Corner> corners_;
  std::vector<Side> sides_; // from corner k to the next
};

} // namespace hybridtree
