// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/CutProjection.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/boolean/CleanResult.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 256;
constexpr int kSteps = 5;
constexpr double kReach = 0.25; // of the edge length
constexpr double kNear = 1e-4;  // of the edge length: on the surface for a mesh
constexpr double kFar = 0.6;    // of the edge length: how far the surface is looked for at corners
constexpr int kSamples = 6;
constexpr int kBisections = 20;
// How near to the cut, in edge lengths, other points may be: more where that does not do.
constexpr double kRooms[] = { 0.15, 0.25, 0.4 };
constexpr double kOnSurface = 1e-7; // of the edge length

struct Miss
{
  double value = 0.0; // T - f
  Vec3 gradient = Vec3::Zero();

  double distance() const
  {
    const double slope = gradient.norm();
    return slope > 0.0 ? std::abs(value) / slope : 0.0;
  }
};

// The shortest step that makes up for both misses.
Vec3 stepFor(const Miss& a, const Miss& b)
{
  const double aa = a.gradient.squaredNorm();
  const double bb = b.gradient.squaredNorm();
  const double ab = a.gradient.dot(b.gradient);
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-4 * aa * bb)) // nearly tangential: no point to go to
  {
    return Vec3::Zero();
  }
  const double s = (a.value * bb - b.value * ab) / determinant;
  const double t = (b.value * aa - a.value * ab) / determinant;
  return s * a.gradient + t * b.gradient;
}

using Misses = std::vector<std::array<Miss, 2>>;

Misses missesAt(const Node& a, const Node& b, const std::vector<Vec3>& points)
{
  Misses misses(points.size());
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      ScratchVectors position(end - begin), gradient(end - begin);
      ScratchArray value(end - begin);
      for (std::size_t k = begin; k < end; ++k)
      {
        position.batch().set(k - begin, points[k]);
      }
      for (std::size_t node = 0; node < 2; ++node)
      {
        (node == 0 ? a : b).fieldAndGradient(position.points(), value.data(), gradient.batch());
        for (std::size_t k = begin; k < end; ++k)
        {
          misses[k][node] = { kThreshold - value[k - begin], gradient.batch()[k - begin] };
        }
      }
    });
  return misses;
}

double worstOf(const std::array<Miss, 2>& miss)
{
  return std::max(miss[0].distance(), miss[1].distance());
}

// Which of the two is the surface of the Boolean there, and how far it is.
const Miss& surfaceOf(BooleanOperation operation, const std::array<Miss, 2>& miss)
{
  switch (operation)
  {
    case BooleanOperation::Union:
      return miss[0].value < miss[1].value ? miss[0] : miss[1];
    case BooleanOperation::Intersection:
      return miss[0].value > miss[1].value ? miss[0] : miss[1];
    case BooleanOperation::Difference:
      break;
  }
  return miss[0].value > -miss[1].value ? miss[0] : miss[1];
}

// The place of each point that comes nearest to both surfaces, and how near.
std::vector<Vec3> steppedTo(const Node& a, const Node& b, const std::vector<Vec3>& start,
  double edgeLength, std::vector<double>& least)
{
  std::vector<Vec3> points = start;
  std::vector<Vec3> best = start;
  for (int step = 0; step <= kSteps; ++step)
  {
    const Misses misses = missesAt(a, b, points);
    bool done = true;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double miss = worstOf(misses[k]);
      const bool near = (points[k] - start[k]).norm() <= kReach * edgeLength;
      if (step == 0 || (near && miss < least[k]))
      {
        least[k] = miss;
        best[k] = points[k];
      }
      if (near && miss > kOnSurface * edgeLength)
      {
        points[k] += stepFor(misses[k][0], misses[k][1]);
        done = false;
      }
    }
    if (done)
    {
      break;
    }
  }
  return best;
}

// The field of the Boolean less T, in its min/max form.
std::vector<double> excessAt(
  BooleanOperation operation, const Node& a, const Node& b, const std::vector<Vec3>& points)
{
  const Misses misses = missesAt(a, b, points);
  std::vector<double> excess(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double inA = -misses[k][0].value;
    const double inB = -misses[k][1].value;
    excess[k] = operation == BooleanOperation::Union ? std::max(inA, inB)
      : operation == BooleanOperation::Intersection  ? std::min(inA, inB)
                                                     : std::min(inA, -inB);
  }
  return excess;
}

// Where a line through each point passes the surface of the Boolean next, by samples and bisection;
// the point itself where it does not within reach.
std::vector<Vec3> bisectedTo(BooleanOperation operation, const Node& a, const Node& b,
  const std::vector<Vec3>& start, const std::vector<Vec3>& direction, double reach)
{
  const std::vector<double> excess = excessAt(operation, a, b, start);
  std::vector<double> inner(start.size(), 0.0);
  std::vector<double> outer(start.size(), 0.0); // 0 as long as nothing is found
  std::vector<Vec3> points(start.size());
  const auto at = [&](std::size_t k, double t) { return Vec3(start[k] + t * direction[k]); };
  for (int sample = 1; sample <= kSamples; ++sample)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const double t = sign * reach * sample / kSamples;
      for (std::size_t k = 0; k < start.size(); ++k)
      {
        points[k] = at(k, t);
      }
      const std::vector<double> there = excessAt(operation, a, b, points);
      for (std::size_t k = 0; k < start.size(); ++k)
      {
        if (outer[k] == 0.0 && (there[k] > 0.0) != (excess[k] > 0.0))
        {
          outer[k] = t;
          inner[k] = sign * reach * (sample - 1) / kSamples;
        }
      }
    }
  }
  for (int step = 0; step < kBisections; ++step)
  {
    for (std::size_t k = 0; k < start.size(); ++k)
    {
      points[k] = at(k, 0.5 * (inner[k] + outer[k]));
    }
    const std::vector<double> there = excessAt(operation, a, b, points);
    for (std::size_t k = 0; k < start.size(); ++k)
    {
      ((there[k] > 0.0) == (excess[k] > 0.0) ? inner : outer)[k] = 0.5 * (inner[k] + outer[k]);
    }
  }
  return points;
}

// Onto both surfaces; where that fails, as where one has a corner, onto that of the Boolean.
std::vector<Vec3> projected(BooleanOperation operation, const Node& a, const Node& b,
  const std::vector<Vec3>& start, double edgeLength)
{
  std::vector<double> least(start.size());
  std::vector<Vec3> points = steppedTo(a, b, start, edgeLength, least);
  std::vector<std::size_t> failed;
  std::vector<Vec3> again;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (least[k] > kNear * edgeLength)
    {
      failed.push_back(k);
      again.push_back(start[k]);
    }
  }
  const Misses misses = missesAt(a, b, again);
  std::vector<Vec3> direction;
  for (const std::array<Miss, 2>& miss : misses)
  {
    direction.push_back(surfaceOf(operation, miss).gradient.normalized());
  }
  again = bisectedTo(operation, a, b, again, direction, kFar * edgeLength);
  for (std::size_t k = 0; k < failed.size(); ++k)
  {
    points[failed[k]] = again[k];
  }
  return points;
}

// Normals of the triangles that those of the result are parts of.
std::vector<Vec3> sourceNormals(const std::array<const TriangleMesh*, 2>& child, bool turnsSecond,
  const MeshBooleanResult& result)
{
  std::vector<Vec3> normals(result.mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t)
  {
    const std::size_t operand = std::size_t(result.sourceOperand[t]);
    const std::int32_t source = result.sourceTriangle[t];
    normals[t] =
      source < 0 ? areaNormal(result.mesh, t) : areaNormal(*child[operand], std::size_t(source));
    if (source >= 0 && operand == 1 && turnsSecond)
    {
      normals[t] = -normals[t];
    }
  }
  return normals;
}

// Takes points of the cut back to where the meshes cross at triangles that they have turned over.
bool takeBackTurned(const std::vector<Vec3>& normals, MeshBooleanResult& result)
{
  std::vector<Vec3>& points = result.mesh.points;
  bool any = false;
  for (bool turned = true; turned;)
  {
    turned = false;
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
    {
      for (const std::int32_t point : result.mesh.triangles[t])
      {
        if (std::size_t(point) < result.firstCut)
        {
          continue;
        }
        const Vec3& start = result.cutPoints[std::size_t(point) - result.firstCut].position;
        if (points[std::size_t(point)] != start &&
          areaNormal(result.mesh, t).dot(normals[t]) <= 0.0)
        {
          points[std::size_t(point)] = start;
          turned = any = true;
        }
      }
    }
  }
  return any;
}

} // namespace

void projectCut(BooleanOperation operation, const std::array<const Node*, 2>& nodes,
  const std::array<const TriangleMesh*, 2>& meshes, double edgeLength, MeshBooleanResult& result)
{
  const bool turnsSecond = operation == BooleanOperation::Difference;
  for (const double room : kRooms)
  {
    std::vector<Vec3> start;
    for (const CutPoint& cut : result.cutPoints)
    {
      start.push_back(cut.position);
    }
    const Misses misses = missesAt(*nodes[0], *nodes[1], start);
    if (std::none_of(misses.begin(), misses.end(),
          [&](const std::array<Miss, 2>& miss) { return worstOf(miss) > kOnSurface * edgeLength; }))
    {
      return; // the surfaces are their meshes
    }
    const std::vector<Vec3> moved = projected(operation, *nodes[0], *nodes[1], start, edgeLength);
    std::copy(
      moved.begin(), moved.end(), result.mesh.points.begin() + std::ptrdiff_t(result.firstCut));
    makeRoomForCut(result, sourceNormals(meshes, turnsSecond, result), room * edgeLength);
    if (!takeBackTurned(sourceNormals(meshes, turnsSecond, result), result))
    {
      break;
    }
  }
}

} // namespace hybridtree
