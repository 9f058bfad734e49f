// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Potential.h"

#include "core/base/Error.h"
#include "core/geometry/SkeletonKernels.h"

#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr int kLargestExponent = 64;
constexpr double kLeastRatio = 1e-6; // its square is told from 1 by four digits of a double

void requireExponent(int exponent)
{
  if (exponent < 2 || exponent > kLargestExponent)
  {
    throw InvalidParameter("Exponent", exponent, "from 2 to 64");
  }
}

void requireInfluenceRadius(double radius)
{
  if (!std::isfinite(radius) || !(radius > 0.0))
  {
    throw InvalidParameter("InfluenceRadius", radius, "a finite length > 0");
  }
}

} // namespace

Potential::Potential(double maximumField, double influenceRadius, int exponent)
  : maximumField_(maximumField), influenceRadius_(influenceRadius), exponent_(exponent)
{
  if (!std::isfinite(maximumField) || maximumField == 0.0)
  {
    throw InvalidParameter("MaximumField", maximumField, "a finite number other than 0");
  }
  requireInfluenceRadius(influenceRadius);
  requireExponent(exponent);
}

Potential Potential::bySurfaceRadius(
  double surfaceRadius, double influenceRadius, int exponent, bool negative)
{
  requireInfluenceRadius(influenceRadius);
  requireExponent(exponent);
  const double ratio = surfaceRadius / influenceRadius;
  const double maximumField = kThreshold / std::pow((1.0 - ratio) * (1.0 + ratio), exponent);
  if (!(surfaceRadius >= 0.0 && ratio < 1.0))
  {
    throw InvalidParameter("SurfaceRadius", surfaceRadius,
      "at least 0 and less than InfluenceRadius, where the field ends");
  }
  if (surfaceRadius > 0.0 && ratio < kLeastRatio)
  {
    throw InvalidParameter("InfluenceRadius", influenceRadius,
      "at most 1000000 times SurfaceRadius, for the surface to be told from the skeleton in double "
      "precision");
  }
  if (!std::isfinite(maximumField))
  {
    throw InvalidParameter("SurfaceRadius", surfaceRadius,
      "farther from InfluenceRadius, for the field between them to be representable; enlarge "
      "InfluenceRadius or lower Exponent");
  }
  return Potential(negative ? -maximumField : maximumField, influenceRadius, exponent);
}

Falloff Potential::falloff() const
{
  // Rounded up, so that the field is exactly 0 from R on.
  const double inverse = 1.0 / influenceRadius_ / influenceRadius_;
  return { maximumField_, inverse * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()),
    exponent_ };
}

void Potential::evaluate(const double* distance, double* field, std::size_t count) const
{
  evaluateFalloff(this->falloff(), distance, field, count);
}

double Potential::evaluate(double distance) const
{
  double field;
  this->evaluate(&distance, &field, 1);
  return field;
}

void Potential::evaluateWithSlope(
  const double* distance, double* field, double* slope, std::size_t count) const
{
  evaluateFalloffWithSlope(this->falloff(), distance, field, slope, count);
}

Interval Potential::range(Interval distance) const
{
  if (distance.min >= influenceRadius_)
  {
    return {};
  }
  const double ends[2] = { distance.min, distance.max };
  double field[2];
  this->evaluate(ends, field, 2);
  return this->isNegative() ? Interval{ field[0], field[1] } : Interval{ field[1], field[0] };
}

std::optional<double> Potential::surfaceRadius() const
{
  const double strength = std::abs(maximumField_);
  if (strength < kThreshold)
  {
    return std::nullopt;
  }
  // 1 - (T / |I|)^(1/n), without the loss of digits near 0.
  const double squaredRatio = -std::expm1(std::log(kThreshold / strength) / exponent_);
  return influenceRadius_ * std::sqrt(squaredRatio);
}

Potential Potential::scaled(double scale) const
{
  return Potential(maximumField_, influenceRadius_ * scale, exponent_);
}

void Potential::describe(Parameters& parameters) const
{
  parameters.set("maximumField", maximumField_);
  parameters.set("influenceRadius", influenceRadius_);
  parameters.set("exponent", exponent_);
}

Potential Potential::fromParameters(const Parameters& parameters)
{
  return Potential(parameters.getDouble("maximumField"), parameters.getDouble("influenceRadius"),
    parameters.getInt("exponent"));
}

} // namespace hybridtree
