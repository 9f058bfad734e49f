// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/CubicSpan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using Quintic = std::array<double, 6>; // Bernstein coefficients

constexpr int kMostHalvings = 40;

// Roots of a t^2 + b t + c in (0, 1).
int quadraticRoots(double a, double b, double c, double roots[2])
{
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0))
  {
    return 0;
  }
  const double half = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  int count = 0;
  for (const double root : { half / a, c / half })
  {
    if (root > 0.0 && root < 1.0) // false for NaN
    {
      roots[count++] = root;
    }
  }
  return count;
}

double bernstein3(const std::array<double, 4>& b, double t)
{
  const double u = 1.0 - t;
  return u * u * u * b[0] + 3.0 * u * t * (u * b[1] + t * b[2]) + t * t * t * b[3];
}

// Range of a cubic in Bernstein form over [0, 1].
Interval cubicRange(const std::array<double, 4>& b)
{
  Interval range{ std::min(b[0], b[3]), std::max(b[0], b[3]) };
  const double d0 = b[1] - b[0];
  const double d1 = b[2] - b[1];
  const double d2 = b[3] - b[2];
  double roots[2];
  const int count = quadraticRoots(d0 - 2.0 * d1 + d2, 2.0 * (d1 - d0), d0, roots);
  for (int k = 0; k < count; ++k)
  {
    const double value = bernstein3(b, roots[k]);
    range.min = std::min(range.min, value);
    range.max = std::max(range.max, value);
  }
  return range;
}

int signChanges(const Quintic& q)
{
  int changes = 0;
  for (int k = 0; k < 5; ++k)
  {
    changes += (q[k] < 0.0) != (q[k + 1] < 0.0);
  }
  return changes;
}

void halve(const Quintic& q, Quintic& low, Quintic& high)
{
  Quintic work = q;
  for (int k = 0; k < 6; ++k)
  {
    low[k] = work[0];
    high[5 - k] = work[5 - k];
    for (int i = 0; i + k < 5; ++i)
    {
      work[i] = 0.5 * (work[i] + work[i + 1]);
    }
  }
}

// Value and derivative at t.
std::pair<double, double> evaluate(const Quintic& q, double t)
{
  Quintic work = q;
  for (int k = 5; k > 1; --k)
  {
    for (int i = 0; i < k; ++i)
    {
      work[i] += t * (work[i + 1] - work[i]);
    }
  }
  return { work[0] + t * (work[1] - work[0]), 5.0 * (work[1] - work[0]) };
}

// The root of a quintic that rises through 0 once in [0, 1], by Newton steps kept in a bracket.
double risingRoot(const Quintic& q)
{
  double low = 0.0;
  double high = 1.0;
  double t = q[0] / (q[0] - q[5]);
  for (int round = 0; round < 80 && high - low > 1e-16; ++round)
  {
    const auto [value, slope] = evaluate(q, t);
    (value < 0.0 ? low : high) = t;
    const double newton = t - value / slope;
    const bool inside = newton >= low && newton <= high;
    const double next = inside ? newton : 0.5 * (low + high);
    const double step = std::abs(next - t);
    t = next;
    if (inside && step < 1e-15)
    {
      break;
    }
  }
  return t;
}

// Offers every place where the antiderivative of q may have its least value in [low, low + width].
template <class Offer>
void forEachMinimum(const Quintic& q, double low, double width, int depth, const Offer& offer)
{
  const int changes = signChanges(q);
  if (changes == 0 || (changes == 1 && q[0] >= 0.0))
  {
    return; // the ends are offered by the caller
  }
  if (changes == 1)
  {
    offer(low + width * risingRoot(q));
    return;
  }
  if (depth == kMostHalvings)
  {
    offer(low + 0.5 * width);
    return;
  }
  Quintic lower;
  Quintic upper;
  halve(q, lower, upper);
  if (lower[5] == 0.0)
  {
    offer(low + 0.5 * width); // a root on the cut belongs to neither half
  }
  forEachMinimum(lower, low, 0.5 * width, depth + 1, offer);
  forEachMinimum(upper, low + 0.5 * width, 0.5 * width, depth + 1, offer);
}

Quintic slopeAt(const PreparedSpan& span, const Vec3& local)
{
  Quintic q = span.self;
  for (int j = 0; j < 3; ++j)
  {
    const double along = span.tangent[j].dot(local);
    for (int k = 0; k < 6; ++k)
    {
      q[k] -= PreparedSpan::kElevation[k][j] * along;
    }
  }
  return q;
}

// Bernstein coefficients of the product of a cubic and a quadratic.
template <class A, class B, class Multiply>
Quintic cubicTimesQuadratic(const A& a, const B& b, const Multiply& multiply)
{
  constexpr double kThree[4] = { 1.0, 3.0, 3.0, 1.0 };
  constexpr double kTwo[3] = { 1.0, 2.0, 1.0 };
  constexpr double kFive[6] = { 1.0, 5.0, 10.0, 10.0, 5.0, 1.0 };
  Quintic product{};
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      product[i + j] += kThree[i] * kTwo[j] / kFive[i + j] * multiply(a[i], b[j]);
    }
  }
  return product;
}

} // namespace

ThickPoint CubicSpan::at(double t) const
{
  const double u = 1.0 - t;
  return u * u * u * control[0] + 3.0 * u * u * t * control[1] + 3.0 * u * t * t * control[2] +
    t * t * t * control[3];
}

ThickPoint CubicSpan::slope(double t) const
{
  const double u = 1.0 - t;
  return 3.0 * u * u * (control[1] - control[0]) + 6.0 * u * t * (control[2] - control[1]) +
    3.0 * t * t * (control[3] - control[2]);
}

ThickPoint CubicSpan::bend(double t) const
{
  return 6.0 * (1.0 - t) * (control[2] - 2.0 * control[1] + control[0]) +
    6.0 * t * (control[3] - 2.0 * control[2] + control[1]);
}

CubicSpan CubicSpan::part(double from, double to) const
{
  // Ends and end slopes say all of a cubic.
  const double third = (to - from) / 3.0;
  const ThickPoint a = this->at(from);
  const ThickPoint b = this->at(to);
  return { { a, a + third * this->slope(from), b - third * this->slope(to), b } };
}

Box3 CubicSpan::bounds() const
{
  CubicSpan thin = *this;
  for (ThickPoint& point : thin.control)
  {
    point.radius = 0.0;
  }
  return thin.ballBounds();
}

Box3 CubicSpan::ballBounds() const
{
  Box3 box(control[0].at);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, 4> low;
    std::array<double, 4> high;
    for (int k = 0; k < 4; ++k)
    {
      low[k] = control[k].at[axis] - control[k].radius;
      high[k] = control[k].at[axis] + control[k].radius;
    }
    box.min()[axis] = cubicRange(low).min;
    box.max()[axis] = cubicRange(high).max;
  }
  return box;
}

bool CubicSpan::thick() const
{
  return std::any_of(
    control.begin(), control.end(), [](const ThickPoint& p) { return p.radius != 0.0; });
}

PreparedSpan::PreparedSpan(const CubicSpan& span)
  : origin(span.control[0].at), box(span.bounds()), thick(span.thick())
{
  largestRadius = std::max_element(span.control.begin(), span.control.end(),
    [](const ThickPoint& a, const ThickPoint& b) {
      return a.radius < b.radius;
    })->radius;
  std::array<Vec3, 4> b;
  for (int k = 0; k < 4; ++k)
  {
    b[k] = span.control[k].at - origin;
    radius[k] = span.control[k].radius;
  }
  for (int k = 0; k < 3; ++k)
  {
    tangent[k] = 3.0 * (b[k + 1] - b[k]);
    widening[k] = 3.0 * (radius[k + 1] - radius[k]);
  }
  power = { b[0], 3.0 * (b[1] - b[0]), 3.0 * (b[2] - 2.0 * b[1] + b[0]),
    b[3] - b[0] + 3.0 * (b[1] - b[2]) };
  radiusPower = { radius[0], 3.0 * (radius[1] - radius[0]),
    3.0 * (radius[2] - 2.0 * radius[1] + radius[0]),
    radius[3] - radius[0] + 3.0 * (radius[1] - radius[2]) };
  self = cubicTimesQuadratic(b, tangent, [](const Vec3& u, const Vec3& v) { return u.dot(v); });
  const Quintic growth =
    cubicTimesQuadratic(radius, widening, [](double u, double v) { return u * v; });
  for (int k = 0; k < 6; ++k)
  {
    self[k] -= growth[k];
  }
  // Tight bounds carry rounding, and decide what is never looked at.
  const double slack = 1e-15 * (box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff());
  box = Box3(Vec3(box.min().array() - slack), Vec3(box.max().array() + slack));
  selfPower.fill(0.0);
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 1; j < 4; ++j)
    {
      selfPower[i + j - 1] += j * (power[i].dot(power[j]) - radiusPower[i] * radiusPower[j]);
    }
  }
}

double PreparedSpan::radiusAt(double t) const
{
  return bernstein3(radius, t);
}

double nearestParameter(const PreparedSpan& span, const Vec3& local)
{
  double best = 0.0;
  double squared = (span.at(0.0) - local).squaredNorm();
  const auto offer = [&](double t)
  {
    const double here = (span.at(t) - local).squaredNorm();
    if (here < squared)
    {
      squared = here;
      best = t;
    }
  };
  offer(1.0);
  forEachMinimum(slopeAt(span, local), 0.0, 1.0, 0, offer);
  return best;
}

double leastThickDistance(const PreparedSpan& span, const Vec3& local, double& t)
{
  const auto distance = [&](double at) { return (span.at(at) - local).norm() - span.radiusAt(at); };
  t = 0.0;
  double least = distance(0.0);
  const auto offer = [&](double at)
  {
    const double here = distance(at);
    if (here < least)
    {
      least = here;
      t = at;
    }
  };
  offer(1.0);
  const Quintic base = slopeAt(span, local);
  for (int round = 0; round < 30; ++round)
  {
    const double before = least;
    Quintic q = base;
    for (int k = 0; k < 6; ++k)
    {
      for (int j = 0; j < 3; ++j)
      {
        q[k] -= before * PreparedSpan::kElevation[k][j] * span.widening[j];
      }
    }
    forEachMinimum(q, 0.0, 1.0, 0, offer);
    if (!(before - least > 1e-15 * (std::abs(before) + span.radius[0])))
    {
      break;
    }
  }
  return least;
}

} // namespace hybridtree
