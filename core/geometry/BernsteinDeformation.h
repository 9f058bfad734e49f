// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/Bernstein.h"
#include "core/geometry/IntervalMath.h"

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace hybridtree
{

/// Free-form deformation of the unit cube (Sederberg and Parry 1986): w(x) = x + D(x) with D of
/// Bernstein form, and the identity outside of the cube. With its inverse, bounds, and whether it
/// folds. As control points at rest reproduce x exactly, D = 0 leaves every point bit for bit.
///
/// A hair beyond the cube (kMargin) counts as inside, so that rounding leaves no point of a face
/// out. Immutable: any number of threads may share it.
class BernsteinDeformation
{
public:
  static constexpr double kMargin = 1e-9;

  /// \param displacements of the control points, in units of the edges of the cube.
  /// \throws InvalidParameter as BernsteinVolume.
  BernsteinDeformation(const std::array<int, 3>& sizes, std::vector<Vec3> displacements);
  ~BernsteinDeformation();

  const BernsteinVolume& displacement() const { return displacement_; }

  /// No control point is displaced.
  bool isIdentity() const { return identity_; }
  /// No control point on a face of the cube is displaced, so that w is continuous.
  bool hasRestingFaces() const { return restingFaces_; }
  static bool isInside(const Vec3& x);

  Vec3 forward(const Vec3& x) const;
  /// Jacobian of w; the identity matrix outside.
  Mat3 jacobian(const Vec3& x) const;
  /// Holds the Jacobian at every point of a part of the cube.
  MatrixInterval jacobianOver(const Box3& part) const;

  enum class Folding
  {
    None,     ///< proved: det J > 0 all over the cube
    Possible, ///< neither proved nor found, within the work allowed
    Certain,  ///< a point with det J <= 0 was found
  };
  /// By subdivision: a cell cannot fold when J stays so close to that of its centre, by bounds of
  /// the second derivatives, that it cannot become singular. Computed once.
  Folding folding() const;

  /// The x with w(x) = y, by damped Newton from y itself, then from the cells whose images hold y;
  /// a deformed point before one at rest where displaced faces leave both. Empty where nothing
  /// comes to y. To 1e-12 of the cube where det J > 0.
  std::optional<Vec3> inverse(const Vec3& y) const;

  /// What is known of the preimages within the cube of a box.
  struct Preimage
  {
    Box3 box; ///< holds them all; empty when there are none
    /// Each of them is center + M v + e, with M in inverseJacobian, |v| <= half the sizes of the
    /// box asked and |e| <= slack; no center where J may become singular in the box.
    std::optional<Vec3> center;
    MatrixInterval inverseJacobian;
    Vec3 slack = Vec3::Zero();
  };
  Preimage preimageOf(const Box3& box) const;

private:
  struct Cells;

  std::optional<Vec3> solve(const Vec3& y, const Vec3& start) const;
  std::optional<Vec3> solveFromCells(const Vec3& y) const;
  Mat3 deviation(const Vec3& half) const;
  Folding findFolding() const;
  const Cells& cells() const;

  BernsteinVolume displacement_;
  bool identity_;
  bool restingFaces_;
  std::array<Mat3, 3> secondBound_; // [a](b, c) >= |d^2 D_a / dx_b dx_c| over the cube
  mutable std::once_flag foldingOnce_;
  mutable Folding folding_ = Folding::Possible;
  mutable std::once_flag cellsOnce_;
  mutable std::unique_ptr<const Cells> cells_;
};

} // namespace hybridtree
