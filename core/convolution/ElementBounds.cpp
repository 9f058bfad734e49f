// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ElementBounds.h"

#include "core/geometry/PointTriangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);

// Over t = d/R from `nearest` to 1, with g = 1 - t^2.
struct KernelBounds
{
  double g;         // of g
  double value;     // of g^n
  double slope;     // of |d g^n / dt| = 2 n t g^(n-1)
  double curvature; // of the second derivatives of g^n as a function in space, times R^2

  KernelBounds(int exponent, double nearest)
  {
    const int n = exponent;
    const auto at = [](double t) { return (1.0 - t) * (1.0 + t); };
    const double steepest = std::max(nearest, std::sqrt(1.0 / (2 * n - 1)));
    const double most = std::max(nearest, std::sqrt(1.0 / (n - 1)));
    g = at(nearest);
    value = integerPower(g, n);
    slope = 2.0 * n * steepest * integerPower(at(steepest), n - 1);
    // Eigenvalues -2 n g^(n-1) across, and that + 4 n (n-1) t^2 g^(n-2) along the way to q.
    curvature = std::max(2.0 * n * integerPower(g, n - 1),
      4.0 * n * (n - 1) * most * most * integerPower(at(most), n - 2));
  }
};

// What distinguishes segments from triangles.
struct Extent
{
  double amplitude;
  double slope;    // of R
  double smallest; // R
  double measure;  // upper bound of the integral over the measure where the kernel is not 0
  double tail;     // integral of ds / R^2, or d^2q / R^3
  double full;     // upper bound of the integral of g^n over all that has g > 0
};

// With mu = sqrt(E) / R^2 ds the measure and E as in ConvolutionElement.h: |grad sqrt(E)| <= slope,
// and within reach sqrt(E) / R is between 1 - slope and 1 + slope.
void add(const Extent& extent, const KernelBounds& kernel, FieldBounds& bounds)
{
  const double m = extent.slope;
  const double inverse = 1.0 / extent.smallest;
  bounds.value += extent.amplitude * std::min(extent.full, kernel.value * extent.measure);
  bounds.slope +=
    extent.amplitude * (kernel.slope * extent.measure * inverse + m * kernel.value * extent.tail);
  bounds.curvature += m == 0.0
    ? extent.amplitude * kernel.curvature * extent.measure * inverse * inverse
    : m >= 0.9 ? std::numeric_limits<double>::infinity()
               : extent.amplitude *
      (kernel.curvature * extent.measure * inverse * inverse +
        m * (2.0 * kernel.slope + kernel.value * m / (1.0 - m)) * extent.tail * inverse);
}

// The Cauchy kernel is 1 / u^2.
double u(double t)
{
  return 1.0 + 4.0 * t * t;
}

// Of the kernel times the measure, per measure, from t = `nearest` on; sqrt(E) / R <= 1 + slope t.
double mostOfCauchy(double slope, double nearest)
{
  const double far = std::max(nearest, std::sqrt(1.0 / 12.0)); // where t / u^2 is largest
  return 1.0 / (u(nearest) * u(nearest)) + slope * far / (u(far) * u(far));
}

double cauchyMeasure(const SegmentElement& element)
{
  return element.length * std::max(element.inverseStart, element.inverseEnd);
}

double areaOf(const TriangleElement& element)
{
  return 0.5 *
    ((element.x[1] - element.x[0]) * (element.y[2] - element.y[0]) -
      (element.x[2] - element.x[0]) * (element.y[1] - element.y[0]));
}

double cauchyMeasure(const TriangleElement& element)
{
  const double inverse = *std::max_element(element.inverse.begin(), element.inverse.end());
  return areaOf(element) * inverse * inverse;
}

void addCauchy(const Extent& extent, double nearest, FieldBounds& bounds)
{
  // Largest values of 16 t / u^3 and 16 t^2 / u^3.
  const double steep = std::max(nearest, std::sqrt(1.0 / 20.0));
  const double farSteep = std::max(nearest, std::sqrt(1.0 / 8.0));
  const double value = 1.0 / (u(nearest) * u(nearest));
  const double slope = 16.0 * steep / integerPower(u(steep), 3);
  const double farSlope = 16.0 * farSteep * farSteep / integerPower(u(farSteep), 3);
  const double m = extent.slope;
  const double inverse = 1.0 / extent.smallest;
  bounds.value +=
    extent.amplitude * std::min(extent.full, extent.measure * mostOfCauchy(m, nearest));
  // |d/dt 1 / u^2| <= 4 / u^2, and second derivatives are below 80 / u^3.
  bounds.slope += extent.amplitude *
    (inverse * std::min(4.0 * extent.full, extent.measure * (slope + m * farSlope)) +
      m * value * extent.tail);
  bounds.curvature += m > 0.0 ? std::numeric_limits<double>::infinity()
                              : extent.amplitude * inverse * inverse * 80.0 / u(nearest) *
      std::min(extent.full, extent.measure * value);
}

} // namespace

double largestReach(const SegmentElement& element)
{
  return 1.0 / std::min(element.inverseStart, element.inverseEnd);
}

double largestReach(const TriangleElement& element)
{
  return 1.0 / *std::min_element(element.inverse.begin(), element.inverse.end());
}

double distanceTo(const SegmentElement& element, const Vec3& p)
{
  const Vec3 from = p - element.start;
  const double along = std::clamp(from.dot(element.direction), 0.0, element.length);
  return (from - along * element.direction).norm();
}

double distanceTo(const TriangleElement& element, const Vec3& p)
{
  const auto corner = [&](std::size_t k)
  {
    return Vec3(
      element.origin + element.axes.leftCols<2>() * Eigen::Vector2d(element.x[k], element.y[k]));
  };
  return std::sqrt(nearestOnTriangle(p, corner(0), corner(1), corner(2)).squaredDistance);
}

Box3 boundsOf(const SegmentElement& element)
{
  Box3 box(element.start);
  box.extend(Vec3(element.start + element.length * element.direction));
  return box;
}

Box3 boundsOf(const TriangleElement& element)
{
  Box3 box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    box.extend(Vec3(
      element.origin + element.axes.leftCols<2>() * Eigen::Vector2d(element.x[k], element.y[k])));
  }
  return box;
}

void addBounds(const SegmentElement& element, const ConvolutionKernel& kernel, double distance,
  FieldBounds& bounds)
{
  const double nearest = distance / largestReach(element);
  if (kernel.kind == KernelKind::Cauchy)
  {
    const double inverse = std::max(element.inverseStart, element.inverseEnd);
    addCauchy({ segmentAmplitude(kernel), std::abs(element.slope), 1.0 / inverse,
                cauchyMeasure(element), element.length * element.inverseStart * element.inverseEnd,
                0.25 * kPi / (u(nearest) * std::sqrt(u(nearest))) },
      nearest, bounds);
    return;
  }
  if (nearest >= 1.0)
  {
    return;
  }
  const KernelBounds most(kernel.exponent, nearest);
  const double slope = std::abs(element.slope);
  const double inverse = std::max(element.inverseStart, element.inverseEnd);
  // The part of an unbounded line with 0 < g <= most.g: all of it, or one of two sides.
  const double chord = 2.0 * std::sqrt(most.g);
  const double measure = std::min(chord, (1.0 + slope) * element.length * inverse);
  const double full = bellIntegral(kernel.exponent) * most.value * 0.5 * chord;
  add({ segmentAmplitude(kernel), slope, 1.0 / inverse, measure,
        element.length * element.inverseStart * element.inverseEnd, full },
    most, bounds);
}

void addBounds(const TriangleElement& element, const ConvolutionKernel& kernel, double distance,
  FieldBounds& bounds)
{
  const double farthest = largestReach(element);
  const double nearest = distance / farthest;
  const double inverse = *std::max_element(element.inverse.begin(), element.inverse.end());
  const double area = areaOf(element);
  if (kernel.kind == KernelKind::Cauchy)
  {
    addCauchy({ triangleAmplitude(kernel), element.slope, 1.0 / inverse, cauchyMeasure(element),
                area * inverse * inverse * inverse, 0.25 * kPi / u(nearest) },
      nearest, bounds);
    return;
  }
  if (nearest >= 1.0)
  {
    return;
  }
  const KernelBounds most(kernel.exponent, nearest);
  const double disc = kPi * most.g;
  const double measure = std::min(disc, (1.0 + element.slope) * area * inverse * inverse);
  const double full = disc * most.value / (kernel.exponent + 1);
  const double tail = std::min(area, kPi * farthest * farthest) * inverse * inverse * inverse;
  add(
    { triangleAmplitude(kernel), element.slope, 1.0 / inverse, measure, tail, full }, most, bounds);
}

void CauchyBound::add(const SegmentElement& element, const ConvolutionKernel& kernel)
{
  box_.extend(boundsOf(element));
  reach_ = std::max(reach_, hybridtree::largestReach(element));
  measure_ += segmentAmplitude(kernel) * cauchyMeasure(element);
  slope_ = std::max(slope_, std::abs(element.slope));
}

void CauchyBound::add(const TriangleElement& element, const ConvolutionKernel& kernel)
{
  box_.extend(boundsOf(element));
  reach_ = std::max(reach_, hybridtree::largestReach(element));
  measure_ += triangleAmplitude(kernel) * cauchyMeasure(element);
  slope_ = std::max(slope_, element.slope);
}

} // namespace hybridtree
