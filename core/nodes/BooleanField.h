// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstddef>

namespace hybridtree
{

enum class BooleanOperation
{
  Union,
  Intersection,
  Difference, ///< A without B
};

enum class BooleanForm
{
  Automatic, ///< MinMax, and Smooth below a blend ([HT] 4.4)
  MinMax,    ///< union max(a, b), intersection min(a, b), difference max(0, min(a, 2T - b))
  Smooth,    ///< Rvachev's R_alpha, alpha falling from 1 at the edge of influence to 0 (see below)
  Paper,     ///< [HT] 4.4 as printed; a difference, which is not printed there, is Smooth
};

/// The field of a Boolean of two fields at one point, and its derivatives by them.
struct BooleanValue
{
  double value = 0.0;
  double byA = 0.0;
  double byB = 0.0;
};

///@{
/// Boolean field functions of two fields a and b, of which the negative part counts as 0:
/// a model that only carves has no inside to unite or to cut. All forms have the same surface f =
/// T.
///
/// Smooth, with a' = a - T, b' = b - T, h(u) = u + u^2 - u^3 on [0, 1], 0 below and 1 above:
///   alpha = 1 - h(a/T) h(b/T)
///   union         T + (a' + b' + sqrt(a'^2 + b'^2 - 2 alpha a' b')) / (1 + alpha)
///   intersection  T + (a' + b' - sqrt(a'^2 + b'^2 - 2 alpha a' b')) / (1 + alpha)
///   difference    as intersection with b' = max(T - b, -T), alpha = 1 - h(a/T) h(b/T) h((2T -
///   b)/T)
/// Compact: the union is 0 only where both are, the intersection where either is, the difference
/// where a is. Neutral: union(a, 0) = a, difference(a, 0) = min(a, 2T). Differentiable but where
/// a = b = T and, for the difference, where b = 2T. Departs from [HT] 4.4, whose intersection
/// reaches outside its operands and whose union with nothing changes a; that one is Paper.
///
/// \pre form is not Automatic. Arrays may be the same. Reentrant.
void booleanField(BooleanOperation operation, BooleanForm form, const double* a, const double* b,
  double* value, std::size_t count);
BooleanValue booleanValue(BooleanOperation operation, BooleanForm form, double a, double b);
///@}

/// Bounds of the Boolean field over all a and b of two intervals, exact up to a thousandth of the
/// intervals' lengths for Smooth and exact for the others.
Interval booleanRange(BooleanOperation operation, BooleanForm form, Interval a, Interval b);

} // namespace hybridtree
