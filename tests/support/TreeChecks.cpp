// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/TreeChecks.h"

#include "core/mesh/MeshDistance.h"
#include "tests/support/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>

namespace hybridtree::test
{
namespace
{

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<double> distancesTo(const MeshPtr& mesh, const PointList& points)
{
  std::vector<double> distance(points.size());
  sharedMeshDistance(mesh)->distance(points, kFar, distance.data());
  return distance;
}

FarPoints farPoints(const MeshPtr& mesh, const PointList& points)
{
  const std::vector<double> distance =
    mesh->empty() ? std::vector<double>(points.size(), kFar) : distancesTo(mesh, points);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return distance[a] > distance[b]; });
  FarPoints far;
  for (const std::size_t k : order)
  {
    far.points.push_back(points[k]);
    far.distances.push_back(distance[k]);
  }
  return far;
}

PointList verticesAndCentres(const TriangleMesh& mesh)
{
  PointList points(mesh.points);
  for (const Triangle& c : mesh.triangles)
  {
    points.add((mesh.points[std::size_t(c[0])] + mesh.points[std::size_t(c[1])] +
                 mesh.points[std::size_t(c[2])]) /
      3.0);
  }
  return points;
}

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(mesh, t).norm();
  }
  return area;
}

bool isBoolean(const Node& node)
{
  return std::string(node.kind()) == "boolean";
}

bool makesItsMesh(const Node& node)
{
  const std::string kind = node.kind();
  return kind == "blend" || kind == "localBlend" || kind == "boolean";
}

// The surface passes within `reach` of the point: f - T has both signs along the gradient there, or
// along an axis where the field has a corner or a jump.
bool isNearSurface(const Node& node, const Vec3& point, const Vec3& gradient, double reach)
{
  PointList around;
  std::vector<Vec3> directions{ Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() };
  if (gradient.norm() > 0.0)
  {
    directions.push_back(gradient.normalized());
  }
  for (const Vec3& direction : directions)
  {
    around.add(point - reach * direction);
    around.add(point + reach * direction);
  }
  std::vector<double> value(around.size());
  node.field(around, value.data());
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  return *low <= kThreshold && *high >= kThreshold;
}

// Keeps the indices of those that are off the surface of a node.
void keepOff(
  const Node& node, const TriangleMesh& mesh, double allowed, std::vector<std::size_t>& off)
{
  PointList points;
  for (const std::size_t k : off)
  {
    points.add(mesh.points[k]);
  }
  VectorList gradient(points.size());
  std::vector<double> value(points.size());
  node.fieldAndGradient(points, value.data(), gradient);
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < off.size(); ++k)
  {
    if (!(std::abs(value[k] - kThreshold) <= allowed * gradient[k].norm()) &&
      !isNearSurface(node, points[k], gradient[k], allowed))
    {
      left.push_back(off[k]);
    }
  }
  off = std::move(left);
}

using PointSet = std::set<std::array<double, 3>>;

std::array<double, 3> asKey(const Vec3& point)
{
  return { point[0], point[1], point[2] };
}

// The meshes below a node that it may have taken over as they are, or cut.
void addMeshesBelow(const Node& node, double edge, std::vector<MeshPtr>& meshes)
{
  for (const NodePtr& child : node.children())
  {
    if (!child->isNegative())
    {
      const MeshPtr mesh = child->mesh(edge);
      if (!mesh->empty())
      {
        meshes.push_back(mesh);
      }
      addMeshesBelow(*child, edge, meshes);
    }
  }
}

} // namespace

SolidCheck checkSolid(
  const Node& tree, const MeshPtr& mesh, double edge, std::size_t count, std::uint64_t seed)
{
  Box3 box = tree.surfaceBounds();
  box.extend(mesh->bounds());
  SolidCheck check;
  if (box.isEmpty() || !(box.volume() > 0.0))
  {
    return check;
  }
  Random random(seed);
  const PointList points = randomPoints(random, box, count);
  std::vector<std::int8_t> inTree(count);
  std::vector<std::int8_t> inMesh(count, -1);
  tree.membership(points, inTree.data());
  if (!mesh->empty())
  {
    sharedMeshDistance(mesh)->side(points, inMesh.data());
  }
  std::ptrdiff_t more = 0;
  PointList wrong;
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool tooMuch = inTree[k] < 0 && inMesh[k] > 0;
    const bool tooLittle = inTree[k] > 0 && inMesh[k] < 0;
    if (tooMuch || tooLittle)
    {
      more += tooMuch ? 1 : -1;
      wrong.add(points[k]);
    }
  }
  const double n = double(count);
  const double mean = double(more) / n;
  check.excess = box.volume() * mean;
  check.sigma = box.volume() * std::sqrt((double(wrong.size()) / n - mean * mean) / n);
  check.chords = edge / 16.0 * areaOf(*mesh);
  check.wrong = farPoints(mesh, wrong);
  return check;
}

std::vector<Vec3> FarPoints::beyond(double limit, double near) const
{
  std::vector<Vec3> kept;
  for (std::size_t k = 0; k < points.size() && distances[k] > limit; ++k)
  {
    if (std::none_of(kept.begin(), kept.end(),
          [&](const Vec3& other) { return (other - points[k]).norm() <= near; }))
    {
      kept.push_back(points[k]);
    }
  }
  return kept;
}

Apart hausdorff(const MeshPtr& a, const MeshPtr& b)
{
  return { farPoints(b, verticesAndCentres(*a)), farPoints(a, verticesAndCentres(*b)) };
}

bool isThin(const Node& tree, const Vec3& point, double edge)
{
  // All in steps of a finer lattice.
  constexpr int kFine = 6; // of them are an edge
  constexpr double kRadius = 0.8661 * kFine;
  constexpr double kRounding = 0.8661;
  constexpr double kReach = kRadius + 0.75 * kFine + kRounding; // from the point to a ball's centre
  constexpr int kSpan = int(kReach + kRadius);
  constexpr int kSide = 2 * kSpan + 1;
  PointList places;
  std::vector<Eigen::Vector3i> centres;
  std::vector<Eigen::Vector3i> ball;
  for (int k = 0; k < kSide * kSide * kSide; ++k)
  {
    const Eigen::Vector3i p(
      k % kSide - kSpan, k / kSide % kSide - kSpan, k / (kSide * kSide) - kSpan);
    places.add(point + edge / kFine * p.cast<double>());
    const double distance = p.cast<double>().norm();
    if (distance <= kReach)
    {
      centres.push_back(p);
    }
    if (distance <= kRadius)
    {
      ball.push_back(p);
    }
  }
  std::vector<std::int8_t> side(places.size());
  tree.membership(places, side.data());
  const auto isInside = [&](const Eigen::Vector3i& p)
  {
    const Eigen::Vector3i at = p.array() + kSpan;
    return side[std::size_t((at.z() * kSide + at.y()) * kSide + at.x())] > 0;
  };
  std::array<bool, 2> found{ false, false };
  for (const Eigen::Vector3i& centre : centres)
  {
    const bool inside = isInside(centre);
    found[inside] = found[inside] ||
      std::all_of(ball.begin(), ball.end(),
        [&](const Eigen::Vector3i& p) { return isInside(centre + p) == inside; });
  }
  return !found[0] || !found[1];
}

std::size_t verticesOffSurface(
  const Node& tree, const TriangleMesh& mesh, double edge, double allowed)
{
  if (!makesItsMesh(tree))
  {
    return 0;
  }
  std::vector<std::size_t> off(mesh.points.size());
  for (std::size_t k = 0; k < off.size(); ++k)
  {
    off[k] = k;
  }
  // A Boolean's surface is made of its children's; where a child has corners its mesh has notches,
  // and what lies in one is not cut away.
  if (isBoolean(tree))
  {
    for (const NodePtr& child : tree.children())
    {
      keepOff(*child, mesh, allowed, off);
    }
  }
  else
  {
    keepOff(tree, mesh, allowed, off);
  }
  if (off.empty())
  {
    return 0;
  }
  std::vector<MeshPtr> below;
  addMeshesBelow(tree, edge, below);
  PointSet taken;
  for (const MeshPtr& child : below)
  {
    for (const Vec3& point : child->points)
    {
      taken.insert(asKey(point));
    }
  }
  PointList left;
  for (const std::size_t k : off)
  {
    if (taken.count(asKey(mesh.points[k])) == 0)
    {
      left.add(mesh.points[k]);
    }
  }
  std::vector<double> least(left.size(), kFar);
  for (const MeshPtr& child : below)
  {
    const std::vector<double> distance = distancesTo(child, left);
    for (std::size_t k = 0; k < left.size(); ++k)
    {
      least[k] = std::min(least[k], distance[k]);
    }
  }
  return std::size_t(std::count_if(
    least.begin(), least.end(), [&](double distance) { return distance > 1e-6 * edge; }));
}

} // namespace hybridtree::test
