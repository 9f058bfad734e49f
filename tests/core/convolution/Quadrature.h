// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

namespace hybridtree::test
{

/// Adaptive integral of f over [a, b] by Gauss and Kronrod's rule of 15 points, to about
/// `tolerance`.
template <typename Function>
double integrate(const Function& f, double a, double b, double tolerance, int depth = 40)
{
  static constexpr std::array<double, 8> kNodes = { 0.991455371120812639206854697526329,
    0.949107912342758524526189684047851, 0.864864423359769072789712788640926,
    0.741531185599394439863864773280788, 0.586087235467691130294144239728810,
    0.405845151377397166906606412076961, 0.207784955007898467600689403773245, 0.0 };
  static constexpr std::array<double, 8> kKronrod = { 0.022935322010529224963732008058970,
    0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
    0.140653259715525918745189590510238, 0.169004726639267902826583426598550,
    0.190350578064785409913256402421014, 0.204432940075298892414161999234649,
    0.209482141084727828012999174891714 };
  static constexpr std::array<double, 4> kGauss = { 0.129484966168869693270611432679082,
    0.279705391489276667901467771423780, 0.381830050505118944950369775488975,
    0.417959183673469387755102040816327 };
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double fine = 0.0;
  double coarse = 0.0;
  for (std::size_t k = 0; k < kNodes.size(); ++k)
  {
    const double value =
      k == 7 ? f(middle) : f(middle - half * kNodes[k]) + f(middle + half * kNodes[k]);
    fine += kKronrod[k] * value;
    coarse += k % 2 == 1 ? kGauss[k / 2] * value : 0.0;
  }
  if (depth == 0 || std::abs(fine - coarse) * half <= tolerance)
  {
    return fine * half;
  }
  return integrate(f, a, middle, 0.5 * tolerance, depth - 1) +
    integrate(f, middle, b, 0.5 * tolerance, depth - 1);
}

} // namespace hybridtree::test
