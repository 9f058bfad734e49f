// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parameters.h"
#include "core/base/Types.h"
#include "core/geometry/Falloff.h"

#include <cstddef>
#include <optional>

namespace hybridtree
{

/// Potential of a leaf: distance to the skeleton in, field value out.
///
/// [HT] 4.1: g(r) = I (1 - r^2/R^2)^n for 0 <= r <= R, and 0 beyond.
/// Units: r and R are model lengths; I and g have none; I < 0 carves.
/// Departs from [HT]: where no surface exists the inverse is empty instead of 0, so that "surface
/// of radius 0" and "no surface" stay two answers.
class Potential
{
public:
  /// \pre I finite and not 0; R finite and > 0; 2 <= n <= 64.
  /// \throws InvalidParameter with the name, the value and the allowed range.
  Potential(double maximumField, double influenceRadius, int exponent);

  /// The potential whose surface lies at surfaceRadius: I = +-T / (1 - r_T^2/R^2)^n.
  /// A negative one reaches -T there. \throws InvalidParameter unless 0 <= surfaceRadius < R and
  /// surfaceRadius is 0 or at least R / 1000000.
  static Potential bySurfaceRadius(
    double surfaceRadius, double influenceRadius, int exponent, bool negative = false);

  /// g at `count` distances >= 0; exactly 0 from R on, which callers may prune by.
  /// The arrays may be the same.
  void evaluate(const double* distance, double* field, std::size_t count) const;
  double evaluate(double distance) const;

  /// g and g' = dg/dr. distance and field may be the same array.
  void evaluateWithSlope(
    const double* distance, double* field, double* slope, std::size_t count) const;

  /// [min, max] of g over an interval of distances.
  Interval range(Interval distance) const;

  /// r_T with |g(r_T)| = T. Empty when |I| < T.
  std::optional<double> surfaceRadius() const;

  /// The same function as kernels over the squared distance take it.
  Falloff falloff() const;

  /// This potential on lengths multiplied by `scale`.
  Potential scaled(double scale) const;

  double maximumField() const { return maximumField_; }
  double influenceRadius() const { return influenceRadius_; }
  int exponent() const { return exponent_; }
  bool isNegative() const { return maximumField_ < 0.0; }

  /// Names "maximumField", "influenceRadius", "exponent".
  void describe(Parameters& parameters) const;
  static Potential fromParameters(const Parameters& parameters);

private:
  double maximumField_;
  double influenceRadius_;
  int exponent_;
};

} // namespace hybridtree
