// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <functional>
#include <vector>

namespace hybridtree
{

/// In the half plane that turns around an axis: (distance from the axis, height along it).
using Vec2 = Eigen::Vector2d;

struct MeridianPoint
{
  Vec2 position;
  Vec2 normal; ///< unit, outward
};

/// The curve that makes a closed surface of revolution by turning around an axis: a chain of pieces
/// in the half plane (radial, height), radial >= 0, parametrised by its length.
///
/// It runs with the outside on its right: from the lower end of the axis to the upper one, or
/// counter-clockwise around. Pieces follow each other without gaps; the normal may jump from one to
/// the next (a crease). Only the two ends of an open meridian may be on the axis.
class Meridian
{
public:
  enum class Kind
  {
    AxisToAxis, ///< starts and ends at radial 0
    Loop,       ///< ends where it starts, radial > 0 throughout
  };
  /// \param symmetric promises that the mirror image in the plane of height 0 is the same curve
  /// backwards. A symmetric loop starts at height 0.
  explicit Meridian(Kind kind, bool symmetric = false) : kind_(kind), symmetric_(symmetric) {}

  ///@{
  /// The next piece. One without length is left out.
  void addLine(const Vec2& from, const Vec2& to);
  /// Part of a circle, between angles measured from the radial direction towards the height. Rising
  /// angles turn left: convex, the normal points away from the centre; falling ones are concave.
  void addArc(const Vec2& center, double radius, double from, double to);
  /// Any other smooth curve: `at` of a length along it, 0 to `length`. It need not be exact as a
  /// length, but points go on the surface where it says and are evenly spaced by it.
  void addCurve(double length, std::function<MeridianPoint(double)> at);
  ///@}

  struct Piece
  {
    double start; ///< length of the chain before it
    double length;
    double turn; ///< angle between the normals of its ends, 0 to pi
    std::function<MeridianPoint(double)> at;
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  bool loop() const { return kind_ == Kind::Loop; }
  bool symmetric() const { return symmetric_; }
  double length() const;

  /// At a length from the start, 0 to length(). Where two pieces meet the normal is the mean of
  /// theirs; on the axis it is along the axis. \pre there is a piece.
  MeridianPoint at(double s) const;

private:
  MeridianPoint joint(std::size_t before, std::size_t after) const;

  Kind kind_;
  bool symmetric_;
  std::vector<Piece> pieces_;
};

/// Angle between two unit vectors, 0 to pi.
double angleBetween(const Vec2& a, const Vec2& b);

} // namespace hybridtree
