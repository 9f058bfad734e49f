// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendEstimate.h"

#include "core/base/Scratch.h"
#include "core/nodes/FieldCost.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

/// A ball has half of the area of its box.
double boxSquares(const Node& node, double cellSize)
{
  constexpr double kShareOfBox = 0.55;
  const Box3 box = node.surfaceBounds();
  if (box.isEmpty())
  {
    return 0.0;
  }
  const Vec3 side = box.sizes() / cellSize;
  return 2.0 * kShareOfBox * (side.x() * side.y() + side.y() * side.z() + side.z() * side.x());
}

/// Evenly spread over a box: the multiples of a vector that is as irrational as can be (Roberts'
/// R3), modulo 1.
void spreadPoints(const Box3& box, std::size_t count, VectorBatch points)
{
  constexpr double kRoot = 1.2207440846057596; // of x^4 = x + 1
  Vec3 step(1.0 / kRoot, 1.0 / (kRoot * kRoot), 1.0 / (kRoot * kRoot * kRoot));
  Vec3 place = Vec3::Constant(0.5);
  for (std::size_t k = 0; k < count; ++k)
  {
    points.set(k, box.min() + place.cwiseProduct(Vec3(box.sizes())));
    place += step;
    place.array() -= place.array().floor();
  }
}

/// Volume of what is near the surface, by its thickness. The distance to the surface is that of the
/// level set of the linear field.
double pointSquares(const Node& node, double cellSize, double squaresOfBox)
{
  constexpr double kSquaresPerPoint = 20.0;
  constexpr double kFewest = 64.0;
  constexpr double kMost = 512.0;
  constexpr double kShareOfMargin = 0.3; // between the surface and the end of the field
  Box3 box = node.surfaceBounds();
  const double margin = 0.5 * (node.influenceBounds().sizes() - box.sizes()).minCoeff();
  const double reach = kShareOfMargin * margin;
  if (!(reach > 0.0))
  {
    return squaresOfBox;
  }
  box.min().array() -= reach;
  box.max().array() += reach;
  const auto count =
    static_cast<std::size_t>(std::clamp(squaresOfBox / kSquaresPerPoint, kFewest, kMost));
  ScratchVectors points(count);
  ScratchVectors gradient(count);
  ScratchArray value(count);
  spreadPoints(box, count, points.batch());
  node.fieldAndGradient(points.points(), value.data(), gradient.batch());
  std::size_t near = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double slope = gradient.points()[k].norm();
    near += slope > 0.0 && std::abs(value[k] - kThreshold) < reach * slope ? 1 : 0;
  }
  const double volume = box.volume() * static_cast<double>(near) / static_cast<double>(count);
  return std::min(volume / (2.0 * reach * cellSize * cellSize), squaresOfBox);
}

} // namespace

BlendCost::Sample sampleCost(const std::vector<MarkTerm>& terms, double edgeLength)
{
  constexpr double kTermsInCell = 2.0;
  BlendCost::Sample sum{ 0.0, 0.0 };
  double squares = 0.0;
  double volume = 0.0;
  for (const MarkTerm& term : terms)
  {
    const Box3 box = term.node->influenceBounds();
    const double cost = fieldCost(*term.node, edgeLength);
    const double common = box.isEmpty() ? 0.0 : term.overlap * box.volume();
    const double area = term.node->isNegative() ? 0.0 : boxSquares(*term.node, edgeLength);
    sum.onSurface += area * cost;
    sum.inCell += kTermsInCell * common * cost;
    squares += area;
    volume += common;
  }
  const double onSurface = squares > 0.0 ? sum.onSurface / squares : 0.0;
  return { onSurface, volume > 0.0 ? sum.inCell / volume : onSurface };
}

double squaresByPoints(const std::vector<MarkTerm>& terms, double cellSize)
{
  double squares = 0.0;
  for (const MarkTerm& term : terms)
  {
    const double most = term.kept ? boxSquares(*term.node, cellSize) : 0.0;
    squares += most > 0.0 ? pointSquares(*term.node, cellSize, most) : 0.0;
  }
  return squares;
}

double squaresGivenUp(const std::vector<MarkTerm>& terms, double cellSize)
{
  double squares = 0.0;
  for (const MarkTerm& term : terms)
  {
    const bool has = !term.kept && !term.node->isNegative();
    squares += has ? (1.0 - term.overlap) * boxSquares(*term.node, cellSize) : 0.0;
  }
  return squares;
}

} // namespace hybridtree
