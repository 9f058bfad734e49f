// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hybridtree
{

/// The unevaluated sum of two doubles, of which `low` is what rounding takes from `high`.
struct TwoDoubles
{
  double high = 0.0;
  double low = 0.0;
};

/// a + b, exactly (Knuth).
inline TwoDoubles twoSum(double a, double b)
{
  const double high = a + b;
  const double rounded = high - a;
  return { high, (a - (high - rounded)) + (b - rounded) };
}

/// The same, for |large| >= |small| or large = 0 (Dekker 1971).
inline TwoDoubles fastTwoSum(double large, double small)
{
  const double high = large + small;
  return { high, small - (high - large) };
}

} // namespace hybridtree
