// SPDX-License-Identifier: BSD-3-Clause
// The closed form of a triangle beside a rule of points: see ConvolutionBenchmark.cpp.
#include "benchmarks/convolution/Works.h"
#include "core/convolution/ConvolutionKernels.h"
#include "tests/support/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hybridtree::test
{
namespace
{

// 8 x 8 nodes on a triangle: collapsed to one corner.
struct Rule
{
  std::array<Vec3, 64> nodes;
  std::array<double, 64> weights;

  Rule(const Vec3& a, const Vec3& b, const Vec3& c)
  {
    constexpr std::array<double, 4> kNodes = { 0.1834346424956498, 0.5255324099163290,
      0.7966664774136267, 0.9602898564975363 };
    constexpr std::array<double, 4> kWeights = { 0.3626837833783620, 0.3137066458778873,
      0.2223810344533745, 0.1012285362903763 };
    const auto node = [&](int k)
    { return 0.5 + (k < 4 ? -0.5 : 0.5) * kNodes[std::size_t(k < 4 ? k : k - 4)]; };
    const auto weight = [&](int k) { return 0.5 * kWeights[std::size_t(k < 4 ? k : k - 4)]; };
    const double jacobian = (b - a).cross(c - a).norm();
    for (int i = 0; i < 8; ++i)
    {
      for (int j = 0; j < 8; ++j)
      {
        const double s = node(i);
        const double t = node(j) * (1.0 - s);
        nodes[std::size_t(8 * i + j)] = a + s * (b - a) + t * (c - a);
        weights[std::size_t(8 * i + j)] = weight(i) * weight(j) * (1.0 - s) * jacobian;
      }
    }
  }
};

// n = 2, one point at a time.
void byPoints(const Rule& rule, double inverseSquared, PointBatch points, double* value)
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < 64; ++i)
    {
      const double g =
        std::max(0.0, 1.0 - (points[k] - rule.nodes[i]).squaredNorm() * inverseSquared);
      sum += rule.weights[i] * g * g;
    }
    value[k] = sum;
  }
}

// The same over batches: vectors as wide as the processor's.
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"))) void inVectors(
  const Rule& rule, double inverseSquared, PointBatch points, double* value)
{
  std::fill_n(value, points.size, 0.0);
  constexpr std::size_t kBlock = 256;
  for (std::size_t begin = 0; begin < points.size; begin += kBlock)
  {
    const std::size_t end = std::min(points.size, begin + kBlock);
    for (std::size_t i = 0; i < 64; ++i)
    {
      const double nx = rule.nodes[i].x();
      const double ny = rule.nodes[i].y();
      const double nz = rule.nodes[i].z();
      const double weight = rule.weights[i];
      for (std::size_t k = begin; k < end; ++k)
      {
        const double dx = points.x[k] - nx;
        const double dy = points.y[k] - ny;
        const double dz = points.z[k] - nz;
        const double rest = 1.0 - (dx * dx + dy * dy + dz * dz) * inverseSquared;
        const double g = rest > 0.0 ? rest : 0.0;
        value[k] += weight * g * g;
      }
    }
  }
}

} // namespace

void printTriangles(int rounds)
{
  std::printf(
    "\nOne triangle, edges in units of R: nanoseconds a point; ratios to the closed form\n"
    "  size     closed     sloped    one by 1   64, one by 1   64, vectors   1by1/closed "
    "vect/closed 1by1/1by1 error of 64\n");
  Random random(1);
  const ConvolutionKernel kernel;
  const double reach = 1.0;
  for (const double size : { 0.5, 1.0, 2.0 })
  {
    const Vec3 a = Vec3::Zero();
    const Vec3 b(size, 0, 0);
    const Vec3 c(0.4 * size, 0.9 * size, 0);
    Box3 box(a);
    box.extend(b).extend(c);
    const PointList points = randomPoints(random,
      Box3(Vec3(box.min() - Vec3::Constant(reach)), Vec3(box.max() + Vec3::Constant(reach))),
      20000);
    const TriangleElement triangle = makeTriangleElement({ a, b, c }, { reach, reach, reach });
    const TriangleElement sloped =
      makeTriangleElement({ a, b, c }, { reach, 1.2 * reach, 1.1 * reach });
    const Rule rule(a, b, c);
    const double amplitude = triangleAmplitude(kernel);
    std::vector<double> closed(points.size());
    std::vector<double> other(points.size());
    const auto sum = [&](const TriangleElement& element, PointBatch batch, double* value)
    {
      const TriangleElement* pointer = &element;
      std::fill_n(value, batch.size, 0.0);
      convolutionKernels(kernel.kind).addTriangles({ &pointer, 1 }, kernel, batch, value);
    };
    const auto singly = [&]
    {
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        sum(triangle, points.batch().slice(k, 1), other.data() + k);
      }
    };
    const std::vector<double> seconds =
      times({ [&] { sum(sloped, points, other.data()); }, singly,
              [&] { byPoints(rule, 1.0 / (reach * reach), points, other.data()); },
              [&] { sum(triangle, points, closed.data()); },
              [&] { inVectors(rule, 1.0 / (reach * reach), points, other.data()); } },
        rounds);
    double error = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      error = std::max(error, std::abs(amplitude * other[k] - closed[k]));
    }
    const auto nanoseconds = [&](std::size_t k) { return 1e9 * seconds[k] / points.size(); };
    std::printf("%6.1f %10.1f %10.1f %10.1f %12.1f %12.1f %10.1f %10.1f %10.1f %10.1e\n", size,
      nanoseconds(3), nanoseconds(0), nanoseconds(1), nanoseconds(2), nanoseconds(4),
      seconds[2] / seconds[3], seconds[4] / seconds[3], seconds[2] / seconds[1], error);
  }
}

} // namespace hybridtree::test
