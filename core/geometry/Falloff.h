// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hybridtree
{

/// h(d) = amplitude * max(0, 1 - d^2 * inverseSquaredRadius)^exponent: a compact bump over a
/// distance d, written so that kernels need only the squared distance. exponent >= 1.
struct Falloff
{
  double amplitude = 1.0;
  double inverseSquaredRadius = 1.0;
  int exponent = 2;
};

} // namespace hybridtree
