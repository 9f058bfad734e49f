// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SubdivisionStep.h"

#include "core/subdivision/SubdivisionMasks.h"

#include <algorithm>
#include <optional>

namespace hybridtree
{
namespace
{

using Vec4 = Eigen::Vector4d; // place and radius
using Kind = SkeletonVertex::Kind;

class Step
{
public:
  Step(const SkeletonGraph& graph, const SkeletonTopology& topology) : topology_(topology)
  {
    values_.reserve(graph.points.size());
    for (std::size_t k = 0; k < graph.points.size(); ++k)
    {
      values_.emplace_back(
        graph.points[k].x(), graph.points[k].y(), graph.points[k].z(), graph.radii[k]);
    }
  }

  std::size_t size() const { return values_.size(); }
  const Vec4& value(std::int32_t point) const { return values_[point]; }

  Vec4 loopVertex(std::int32_t point) const;
  Vec4 loopEdge(const SkeletonEdge& edge) const;
  Vec4 butterflyEdge(const SkeletonEdge& edge) const;

private:
  const SkeletonVertex& vertex(std::int32_t point) const { return topology_.vertices()[point]; }
  Vec4 midpoint(const SkeletonEdge& edge) const
  {
    return 0.5 * (value(edge.ends[0]) + value(edge.ends[1]));
  }
  SectorShape shape(std::int32_t point, const SkeletonSector& sector) const;
  // Of an end where the plain masks would not do; empty elsewhere.
  std::optional<Vec4> loopFrom(std::int32_t point, const SkeletonEdge& edge) const;
  std::optional<Vec4> butterflyFrom(std::int32_t point, const SkeletonEdge& edge) const;
  Vec4 fourPoint(const SkeletonEdge& edge) const;
  Vec4 beyond(std::int32_t point, std::int32_t from) const;
  Vec4 regularButterfly(const SkeletonEdge& edge) const;
  Vec4 wing(std::int32_t triangle, std::int32_t a, std::int32_t b) const;

  const SkeletonTopology& topology_;
  std::vector<Vec4> values_;
};

Vec4 Step::loopVertex(std::int32_t point) const
{
  const SkeletonVertex& v = vertex(point);
  if (v.kind == Kind::Corner)
  {
    return value(point);
  }
  if (v.kind == Kind::Curve)
  {
    return 0.75 * value(point) + 0.125 * (value(v.along[0]) + value(v.along[1]));
  }
  Vec4 sum = Vec4::Zero();
  std::size_t n = 0;
  for (auto [e, end] = topology_.edgesAt(point); e != end; ++e)
  {
    const SkeletonEdge& edge = topology_.edges()[*e];
    if (edge.onSurface())
    {
      sum += value(edge.otherEnd(point));
      ++n;
    }
  }
  const double weight = loopNeighbourWeight(n);
  return (1.0 - double(n) * weight) * value(point) + weight * sum;
}

SectorShape Step::shape(std::int32_t point, const SkeletonSector& sector) const
{
  const SkeletonVertex& v = vertex(point);
  const bool passes = v.kind == Kind::Curve && v.beyond(sector.ring.front()) == sector.ring.back();
  return passes ? SectorShape::Straight : SectorShape::Corner;
}

std::optional<Vec4> Step::loopFrom(std::int32_t point, const SkeletonEdge& edge) const
{
  std::size_t place = 0;
  if (vertex(point).kind == Kind::Surface)
  {
    return {};
  }
  const SkeletonSector sector = topology_.sector(point, edge, place);
  if (sector.closed)
  {
    return {};
  }
  const double weight = loopSectorWeight(sector.triangles(), shape(point, sector));
  return (0.75 - weight) * value(point) + weight * value(edge.otherEnd(point)) +
    0.125 * (value(sector.ring[place - 1]) + value(sector.ring[place + 1]));
}

// One mask for the edge out of those of its ends: their mean where both have one.
template <class Regular>
Vec4 chosen(const std::optional<Vec4>& a, const std::optional<Vec4>& b, const Regular& regular)
{
  return a && b ? Vec4(0.5 * (*a + *b)) : a ? *a : b ? *b : regular();
}

Vec4 Step::loopEdge(const SkeletonEdge& edge) const
{
  if (edge.sharp())
  {
    return midpoint(edge);
  }
  return chosen(loopFrom(edge.ends[0], edge), loopFrom(edge.ends[1], edge),
    [&]() -> Vec4
    {
      return 0.75 * midpoint(edge) +
        0.125 *
        (value(topology_.opposite(edge.triangles[0], edge)) +
          value(topology_.opposite(edge.triangles[1], edge)));
    });
}

Vec4 Step::beyond(std::int32_t point, std::int32_t from) const
{
  const std::int32_t next = vertex(point).beyond(from);
  return next >= 0 ? value(next) : Vec4(2.0 * value(point) - value(from));
}

Vec4 Step::fourPoint(const SkeletonEdge& edge) const
{
  const auto [a, b] = edge.ends;
  return 1.125 * midpoint(edge) - 0.0625 * (beyond(a, b) + beyond(b, a));
}

Vec4 Step::wing(std::int32_t triangle, std::int32_t a, std::int32_t b) const
{
  const SkeletonEdge& side = topology_.edges()[topology_.triangleEdge(triangle, a, b)];
  if (side.sharp())
  {
    return value(a) + value(b) - value(topology_.opposite(triangle, side));
  }
  return value(topology_.opposite(side.triangles[side.triangles[0] == triangle ? 1 : 0], side));
}

Vec4 Step::regularButterfly(const SkeletonEdge& edge) const
{
  const auto [a, b] = edge.ends;
  Vec4 sum = midpoint(edge);
  for (std::int32_t triangle : edge.triangles)
  {
    const std::int32_t c = topology_.opposite(triangle, edge);
    sum += 0.125 * value(c) - 0.0625 * (wing(triangle, a, c) + wing(triangle, b, c));
  }
  return sum;
}

std::optional<Vec4> Step::butterflyFrom(std::int32_t point, const SkeletonEdge& edge) const
{
  std::size_t place = 0;
  const SkeletonSector sector = topology_.sector(point, edge, place);
  const std::size_t size = sector.ring.size();
  RingMask mask;
  if (sector.closed)
  {
    if (size == 6)
    {
      return {};
    }
    mask = butterflyRingMask(size);
  }
  else
  {
    const SectorShape form = shape(point, sector);
    if (form == SectorShape::Straight && sector.triangles() == 3)
    {
      return {};
    }
    mask = butterflySectorMask(sector.triangles(), place, form);
    place = 0;
  }
  Vec4 sum = mask.center * value(point);
  for (std::size_t j = 0; j < size; ++j)
  {
    sum += mask.ring[j] * value(sector.ring[(place + j) % size]);
  }
  return sum;
}

Vec4 Step::butterflyEdge(const SkeletonEdge& edge) const
{
  Vec4 result = edge.sharp()
    ? fourPoint(edge)
    : chosen(butterflyFrom(edge.ends[0], edge), butterflyFrom(edge.ends[1], edge),
        [&] { return regularButterfly(edge); });
  result[3] = std::max(result[3], 0.5 * std::min(value(edge.ends[0])[3], value(edge.ends[1])[3]));
  return result;
}

} // namespace

SkeletonGraph subdividedPoints(
  const SkeletonGraph& graph, const SkeletonTopology& topology, SubdivisionScheme scheme)
{
  const Step step(graph, topology);
  const bool approximating = scheme == SubdivisionScheme::Approximating;
  SkeletonGraph result;
  const std::size_t count = step.size() + topology.edges().size();
  result.points.reserve(count);
  result.radii.reserve(count);
  const auto add = [&](const Vec4& value)
  {
    result.points.push_back(value.head<3>());
    result.radii.push_back(value[3]);
  };
  for (std::size_t k = 0; k < step.size(); ++k)
  {
    const auto point = std::int32_t(k);
    add(approximating ? step.loopVertex(point) : step.value(point));
  }
  for (const SkeletonEdge& edge : topology.edges())
  {
    add(approximating ? step.loopEdge(edge) : step.butterflyEdge(edge));
  }
  return result;
}

} // namespace hybridtree
