// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hybridtree
{

enum class KernelKind
{
  Compact, ///< h(d) = (1 - d^2/R^2)^n up to d = R, 0 beyond: [HT] 4.1
  Cauchy   ///< h(d) = 1 / (1 + (2 d/R)^2)^2 without end ([SUB]'s reference 16, Sherstyuk 1999)
};

/// How the field of a skeleton falls off with the distance from it. R = influenceRatio * r, r being
/// the radius of the skeleton at the place.
struct ConvolutionKernel
{
  KernelKind kind = KernelKind::Compact;
  int exponent = 2;            ///< n, 2 to 8; the Cauchy kernel has none
  double influenceRatio = 2.0; ///< R / r, > 1
};

inline constexpr int kMaxKernelExponent = 8;

/// \throws InvalidParameter for a value out of its range.
void validate(const ConvolutionKernel& kernel);

/// By what integrals over h in units of R are multiplied, so that a long straight curve
/// (segmentAmplitude) and a wide flat sheet (triangleAmplitude) of radius r have the field T at
/// distance r. With c = 1 - r^2/R^2 and B_n the integral of (1 - x^2)^n over [-1, 1] that is
/// T / (c^(n+1/2) B_n) and T (n + 1) / (pi c^(n+1)) for the compact kernel.
///@{
double segmentAmplitude(const ConvolutionKernel& kernel);
double triangleAmplitude(const ConvolutionKernel& kernel);
///@}

/// The Cauchy kernel never ends, the field of a leaf must: sums below kFadeEnd are 0, those above
/// twice that stay, between them is a cubic with equal slopes at both ends.
///@{
inline constexpr double kFadeEnd = 0.00025;
double faded(double field);
double fadedSlope(double field); ///< derivative of faded()
///@}

/// B_n.
double bellIntegral(int exponent);

/// For small exponents >= 0, where std::pow() would take longer than what it is for.
inline double integerPower(double base, int exponent)
{
  double result = 1.0;
  for (int k = 0; k < exponent; ++k)
  {
    result *= base;
  }
  return result;
}

} // namespace hybridtree
