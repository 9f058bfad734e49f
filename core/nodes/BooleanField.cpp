// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanField.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double T = kThreshold;
const double kPaperUnion = 1.0 / (2.0 - std::sqrt(2.0));
const double kPaperIntersection = 1.0 / (2.0 + std::sqrt(2.0));

// The smooth functions may fall by this slope in one operand (largest seen over [0, 20 T]^2:
// 0.0045).
constexpr double kSmoothSlack = 0.005;

double h(double u)
{
  u = std::clamp(u, 0.0, 1.0);
  return u * (1.0 + u * (1.0 - u));
}

double hSlope(double u)
{
  return u > 0.0 && u < 1.0 ? 1.0 + u * (2.0 - 3.0 * u) : 0.0;
}

// R_alpha of a' and b' with overlap H = 1 - alpha; sign +1 unites, -1 intersects. The square under
// the root is written so that H = 0 gives exactly max and min.
double rAlpha(double a, double b, double overlap, double sign)
{
  const double square = (a - b) * (a - b) + 2.0 * overlap * a * b;
  return T + (a + b + sign * std::sqrt(std::max(square, 0.0))) / (2.0 - overlap);
}

// The operands of a smooth function at one point: values and how they change with the fields.
struct SmoothOperands
{
  double a, b;    // a', b'
  double overlap; // H
  double bByB;    // db'/db
  double overlapByA, overlapByB;
};

// H is 0 where a field is: alpha = 1 there, though h alone would be steep.
SmoothOperands smoothOperands(double a, double b)
{
  const double ha = h(a / T);
  const double hb = h(b / T);
  return { a - T, b - T, ha * hb, 1.0, hSlope(a / T) * hb / T, ha * hSlope(b / T) / T };
}

SmoothOperands smoothDifferenceOperands(double a, double b)
{
  const double ha = h(a / T);
  const double hb = h(b / T);
  const double rest = h((2.0 * T - b) / T);
  const double slopeB = (hSlope(b / T) * rest - hb * hSlope((2.0 * T - b) / T)) / T;
  return { a - T, std::max(T - b, -T), ha * hb * rest, b < 2.0 * T ? -1.0 : 0.0,
    hSlope(a / T) * hb * rest / T, ha * slopeB };
}

BooleanValue rAlphaWithSlopes(const SmoothOperands& o, double sign)
{
  const double square = std::max((o.a - o.b) * (o.a - o.b) + 2.0 * o.overlap * o.a * o.b, 0.0);
  const double root = std::sqrt(square);
  const double scale = 1.0 / (2.0 - o.overlap);
  const double sum = o.a + o.b + sign * root;
  double rootByA = std::sqrt(0.5); // at the corner a' = b' = 0: the gradient seen from the diagonal
  double rootByB = rootByA;
  double rootByOverlap = 0.0;
  if (root > 0.0)
  {
    rootByA = ((o.a - o.b) + o.overlap * o.b) / root;
    rootByB = ((o.b - o.a) + o.overlap * o.a) / root;
    rootByOverlap = o.a * o.b / root;
  }
  const double byOverlap = scale * (sign * rootByOverlap + sum * scale);
  return { T + sum * scale, scale * (1.0 + sign * rootByA) + byOverlap * o.overlapByA,
    scale * (1.0 + sign * rootByB) * o.bByB + byOverlap * o.overlapByB };
}

double paper(double a, double b, double sign, double factor)
{
  a -= T;
  b -= T;
  return T + factor * (a + b + sign * std::sqrt(a * a + b * b));
}

BooleanValue paperWithSlopes(double a, double b, double sign, double factor)
{
  a -= T;
  b -= T;
  const double root = std::sqrt(a * a + b * b);
  const double rootByA = root > 0.0 ? a / root : std::sqrt(0.5);
  const double rootByB = root > 0.0 ? b / root : std::sqrt(0.5);
  return { T + factor * (a + b + sign * root), factor * (1.0 + sign * rootByA),
    factor * (1.0 + sign * rootByB) };
}

template <typename Function>
void forEach(const double* a, const double* b, double* value, std::size_t count, Function function)
{
  for (std::size_t k = 0; k < count; ++k)
  {
    value[k] = function(std::max(a[k], 0.0), std::max(b[k], 0.0));
  }
}

// Where one operand is 0 the smooth functions are the other, min or 0; said outright, so that the
// result is the same bits whether or not the operand was dropped before.
double smoothUnion(double a, double b)
{
  const double overlap = h(a / T) * h(b / T);
  return overlap > 0.0 ? rAlpha(a - T, b - T, overlap, 1.0) : std::max(a, b);
}

double smoothIntersection(double a, double b)
{
  const double overlap = h(a / T) * h(b / T);
  return overlap > 0.0 ? std::max(rAlpha(a - T, b - T, overlap, -1.0), 0.0) : std::min(a, b);
}

double minMaxDifference(double a, double b)
{
  return std::max(0.0, std::min(a, 2.0 * T - b));
}

double smoothDifference(double a, double b)
{
  const double overlap = h(a / T) * h(b / T) * h((2.0 * T - b) / T);
  return overlap > 0.0 ? std::max(rAlpha(a - T, T - b, overlap, -1.0), 0.0)
                       : minMaxDifference(a, b);
}

double paperUnion(double a, double b)
{
  return paper(a, b, 1.0, kPaperUnion);
}

double paperIntersection(double a, double b)
{
  return std::max(paper(a, b, -1.0, kPaperIntersection), 0.0);
}

BooleanValue minMaxWithSlopes(BooleanOperation operation, double a, double b)
{
  switch (operation)
  {
    case BooleanOperation::Union:
      return a >= b ? BooleanValue{ a, 1.0, 0.0 } : BooleanValue{ b, 0.0, 1.0 };
    case BooleanOperation::Intersection:
      return a <= b ? BooleanValue{ a, 1.0, 0.0 } : BooleanValue{ b, 0.0, 1.0 };
    case BooleanOperation::Difference:
      break;
  }
  const double c = 2.0 * T - b;
  if (std::min(a, c) <= 0.0)
  {
    return {};
  }
  return a <= c ? BooleanValue{ a, 1.0, 0.0 } : BooleanValue{ c, 0.0, -1.0 };
}

BooleanValue smoothWithSlopes(BooleanOperation operation, double a, double b)
{
  switch (operation)
  {
    case BooleanOperation::Union:
      return rAlphaWithSlopes(smoothOperands(a, b), 1.0);
    case BooleanOperation::Intersection:
      return rAlphaWithSlopes(smoothOperands(a, b), -1.0);
    case BooleanOperation::Difference:
      break;
  }
  return rAlphaWithSlopes(smoothDifferenceOperands(a, b), -1.0);
}

double booleanScalar(BooleanOperation operation, BooleanForm form, double a, double b)
{
  double value = 0.0;
  booleanField(operation, form, &a, &b, &value, 1);
  return value;
}

} // namespace

void booleanField(BooleanOperation operation, BooleanForm form, const double* a, const double* b,
  double* value, std::size_t count)
{
  const bool smooth = form == BooleanForm::Smooth;
  const bool printed = form == BooleanForm::Paper;
  switch (operation)
  {
    case BooleanOperation::Union:
      if (smooth)
      {
        return forEach(a, b, value, count, smoothUnion);
      }
      if (printed)
      {
        return forEach(a, b, value, count, paperUnion);
      }
      return forEach(a, b, value, count, [](double x, double y) { return std::max(x, y); });
    case BooleanOperation::Intersection:
      if (smooth)
      {
        return forEach(a, b, value, count, smoothIntersection);
      }
      if (printed)
      {
        return forEach(a, b, value, count, paperIntersection);
      }
      return forEach(a, b, value, count, [](double x, double y) { return std::min(x, y); });
    case BooleanOperation::Difference:
      break;
  }
  if (smooth || printed)
  {
    return forEach(a, b, value, count, smoothDifference);
  }
  forEach(a, b, value, count, minMaxDifference);
}

BooleanValue booleanValue(BooleanOperation operation, BooleanForm form, double a, double b)
{
  const double p = std::max(a, 0.0);
  const double q = std::max(b, 0.0);
  BooleanValue result;
  if (form == BooleanForm::Paper && operation != BooleanOperation::Difference)
  {
    const bool unite = operation == BooleanOperation::Union;
    result = paperWithSlopes(p, q, unite ? 1.0 : -1.0, unite ? kPaperUnion : kPaperIntersection);
  }
  else if (form == BooleanForm::Smooth || form == BooleanForm::Paper)
  {
    result = smoothWithSlopes(operation, p, q);
  }
  else
  {
    result = minMaxWithSlopes(operation, p, q);
  }
  result.value = booleanScalar(operation, form, a, b); // the same bits as without slopes
  result.byA = a < 0.0 ? 0.0 : result.byA;
  result.byB = b < 0.0 ? 0.0 : result.byB;
  return result;
}

Interval booleanRange(BooleanOperation operation, BooleanForm form, Interval a, Interval b)
{
  a = { std::max(a.min, 0.0), std::max(a.max, 0.0) };
  b = { std::max(b.min, 0.0), std::max(b.max, 0.0) };
  const bool difference = operation == BooleanOperation::Difference;
  // With one operand alone nothing falls.
  const bool both = a.max > 0.0 && b.max > 0.0;
  if (difference)
  {
    std::swap(b.min, b.max); // the only operand in which anything falls
  }
  Interval range = { booleanScalar(operation, form, a.min, b.min),
    booleanScalar(operation, form, a.max, b.max) };
  if (both && (form == BooleanForm::Smooth || (form == BooleanForm::Paper && difference)))
  {
    const double slack = kSmoothSlack * (a.max - a.min + std::abs(b.max - b.min));
    range.min = std::max(0.0, range.min - slack);
    range.max += slack;
  }
  return range;
}

} // namespace hybridtree
