// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendEstimate.h"

#include "core/base/Scratch.h"
#include "core/nodes/FieldCost.h"
#include "core/nodes/SurfaceProjection.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);

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

/// How many points tell of a surface.
struct Density
{
  double squaresPerPoint;
  double most;
};
constexpr Density kForArea = { 20.0, 512.0 };
constexpr Density kForStretch = { 5.0, 2048.0 }; // what stretches may be small

/// Of the way from the surface to the end of the field, what counts as near.
constexpr double kNear = 0.3;

double marginOf(const Node& node)
{
  return 0.5 * (node.influenceBounds().sizes() - node.surfaceBounds().sizes()).minCoeff();
}

/// Calls visit(point, field, gradient) at those of some points around the surface that are near to
/// it: the distance to the surface is that of the level set of the linear field. \return the area
/// for which each of them stands, in squared cells, by the volume of what is near and its
/// thickness. 0 where the field has no margin.
template <typename Visit>
double visitNear(const Node& node, double cellSize, double squaresOfBox, const Density& density,
  const Visit& visit)
{
  constexpr double kFewest = 64.0;
  Box3 box = node.surfaceBounds();
  const double reach = kNear * marginOf(node);
  if (!(reach > 0.0))
  {
    return 0.0;
  }
  box.min().array() -= reach;
  box.max().array() += reach;
  const auto count = static_cast<std::size_t>(
    std::clamp(squaresOfBox / density.squaresPerPoint, kFewest, density.most));
  ScratchVectors points(count);
  ScratchVectors gradient(count);
  ScratchArray value(count);
  spreadPoints(box, count, points.batch());
  node.fieldAndGradient(points.points(), value.data(), gradient.batch());
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 slope = gradient.points()[k];
    if (slope.norm() > 0.0 && std::abs(value[k] - kThreshold) < reach * slope.norm())
    {
      visit(points.points()[k], value[k], slope);
    }
  }
  return box.volume() / static_cast<double>(count) / (2.0 * reach * cellSize * cellSize);
}

double pointSquares(const Node& node, double cellSize, double squaresOfBox)
{
  std::size_t near = 0;
  const double area = visitNear(
    node, cellSize, squaresOfBox, kForArea, [&](const Vec3&, double, const Vec3&) { ++near; });
  return area > 0.0 ? std::min(static_cast<double>(near) * area, squaresOfBox) : squaresOfBox;
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

SurfaceSample sampleSurfaces(const std::vector<MeshPtr>& meshes)
{
  constexpr std::size_t kMost = 2048; // of each
  SurfaceSample sample;
  for (const MeshPtr& mesh : meshes)
  {
    const std::size_t step = mesh->triangles.size() / kMost + 1;
    for (std::size_t t = 0; t < mesh->triangles.size(); t += step)
    {
      const Vec3 normal = areaNormal(*mesh, t);
      const double area = normal.norm();
      const Triangle& corner = mesh->triangles[t];
      if (area > 0.0)
      {
        const Vec3 middle =
          (mesh->points[corner[0]] + mesh->points[corner[1]] + mesh->points[corner[2]]) / 3.0;
        sample.points.push_back({ middle, normal / area, static_cast<double>(step) * area });
      }
    }
  }
  return sample;
}

BlendSample::BlendSample(const Node& blend, const std::vector<MarkTerm>& shapes, double cellSize)
{
  for (const MarkTerm& shape : shapes)
  {
    const Node& node = *shape.node;
    const double squares = node.isNegative() ? 0.0 : boxSquares(node, cellSize);
    if (!(squares > 0.0))
    {
      continue;
    }
    Part part{ &shape, 0.0, 2.0 * kNear * marginOf(node), {}, {}, {} };
    part.squaresPerPoint = visitNear(node, cellSize, squares, kForStretch,
      [&](const Vec3& point, double field, const Vec3& gradient)
      {
        part.points.push_back(point);
        part.normals.push_back(-gradient.stableNormalized());
        part.fields.push_back(field);
      });
    this->addVisible(blend, part);
    parts_.push_back(std::move(part));
  }
}

/// What the others add or take where a shape's surface is tells whether it is inside of them.
void BlendSample::addVisible(const Node& blend, const Part& part)
{
  const std::size_t count = part.points.size();
  ScratchVectors points(count);
  ScratchArray field(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    points.batch().set(k, part.points[k]);
  }
  blend.field(points.points(), field.data());
  for (std::size_t k = 0; k < count; ++k)
  {
    if (std::abs(field[k] - part.fields[k]) < kThreshold)
    {
      surface_.points.push_back({ part.points[k], part.normals[k], part.squaresPerPoint });
    }
  }
}

double BlendSample::squares() const
{
  double sum = 0.0;
  for (const SurfaceSample::Point& point : surface_.points)
  {
    sum += point.area;
  }
  return sum;
}

// A needle that falls on a surface of area A anyhow meets lines of length l on it with a chance of
// 2 l / (pi A) times its length (Buffon, Crofton).
DeformedBlendCost::Division BlendSample::division(const CellSet& cells, const CellGrid& grid) const
{
  constexpr double kNeedle = 3.0;             // cells
  constexpr double kTurn = 2.399963229728653; // the golden angle: all directions alike
  DeformedBlendCost::Division division{ 0.0, 0.0 };
  for (const Part& part : parts_)
  {
    if (!part.shape->kept)
    {
      continue;
    }
    std::vector<Vec3> places = part.points;
    for (std::size_t k = 0; k < part.points.size(); ++k)
    {
      const Eigen::AngleAxisd turn(static_cast<double>(k) * kTurn, part.normals[k]);
      places.push_back(
        part.points[k] + kNeedle * grid.cellSize * (turn * part.normals[k].unitOrthogonal()));
    }
    std::vector<Vec3> noNormals;
    projectOntoSurface(*part.shape->node, part.reach, places, noNormals);
    const std::size_t count = part.points.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const bool begins = cells.contains(grid.cellAt(places[k]));
      const bool ends = cells.contains(grid.cellAt(places[count + k]));
      division.kept += begins ? 0.0 : part.squaresPerPoint;
      division.border += begins != ends ? 0.5 * kPi * part.squaresPerPoint / kNeedle : 0.0;
    }
  }
  return division;
}

} // namespace hybridtree
