// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"
#include "core/skeletons/RingMesh.h"

#include <utility>
#include <vector>

namespace hybridtree
{

/// The tube around a curve, and beside it the same drawn straight: a surface of revolution whose
/// height y runs along the curve, with lengths as on the outer side of its bends. A ring of points
/// at one height is a circle around the curve, so what is planned straight is bent ring by ring.
///
/// Frames minimise rotation (double reflection, Wang, Juettler, Zheng, Liu 2008); closed curves
/// spread the twist that is left over their length. Refers to the spans.
class Tube
{
public:
  /// \pre the curve stands still nowhere. \param edgeLength for which bends are drawn longer.
  Tube(const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength);

  /// Whether y grows along the tube: it does not where balls swallow their neighbours.
  bool monotone() const;

  double from() const { return y_.front(); }
  double to() const { return y_.back(); }
  double curveLength() const { return along_.back(); }
  double largestRadius() const { return largest_; }

  /// In the straight drawing, at a y between from() and to().
  MeridianPoint place(double y) const;

  /// Of the ball at the start or end: where its center is drawn, its radius, and the angle over the
  /// plane across the curve at which the round end begins.
  struct End
  {
    double center;
    double radius;
    double angle;
  };
  End end(bool last) const;

  /// Takes a ring from the straight drawing to where it belongs: its place becomes that in the
  /// frame returned. Those before from() and behind to() are on the round ends.
  RevolvedFrame bend(Ring& ring) const;

private:
  // `at` counts spans: 2.5 is the middle of the third.
  struct Station
  {
    ThickPoint center; ///< with the radius of the tube
    Vec3 tangent;      ///< unit
    double lean;       ///< component of the surface's normal along the curve
  };
  Station station(double at) const;
  double parameter(double y) const;

  void sample(double edgeLength);
  double growth(const CubicSpan& span, double t, double edgeLength) const;
  void transport();
  Vec3 transported(std::size_t k, const Station& to) const;
  RevolvedFrame frame(double at, const Station& here) const;

  const std::vector<CubicSpan>& spans_;
  bool closed_;
  double radius_;
  double largest_ = 0.0;
  double twist_ = 0.0;
  std::vector<Station> stations_;                 // at each sample
  std::vector<double> along_;                     // outer length of the curve
  std::vector<std::pair<double, double>> growth_; // of that from each sample to the next, at both
  std::vector<double> y_; // of the circle that the ball there gives the surface
  std::vector<Vec3> side_;
};

} // namespace hybridtree
