// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceMesh.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr int kMaxRounds = 30;
constexpr double kShortest = 0.1;    // edge that may be split, in radii
constexpr double kReach = 0.4;       // of the middle of an edge to the surface, in edge lengths
constexpr double kOpposite = -0.2;   // cosine between the normals at both ends of an edge that cuts
constexpr double kNearby = 0.25;     // an axis that is still where it was, in radii
constexpr double kClearly = 1.00001; // so that rounding does not choose between equal edges
constexpr std::int32_t kSettled = -1;
constexpr std::int32_t kToSplit = -2;

using Edge = std::array<std::int32_t, 2>;

std::uint64_t keyOf(std::int32_t a, std::int32_t b)
{
  return std::uint64_t(std::uint32_t(std::min(a, b))) << 32 | std::uint32_t(std::max(a, b));
}

class Refiner
{
public:
  Refiner(const PieceCage& cage, const FieldSource& field, const PieceMeshOptions& options)
    : field_(field), options_(options), radii_(cage.radii)
  {
    mesh_.triangles = cage.triangles;
  }

  PieceMesh run(
    const PieceCage& cage, const std::vector<SkeletonAxis>& before, const Progress& progress)
  {
    placeCage(cage, before);
    for (int round = 0; round < kMaxRounds && splitEdges(); ++round)
    {
      progress.check();
      divideTriangles();
    }
    return std::move(mesh_);
  }

private:
  std::vector<Vec3> middlesOf(const std::vector<Edge>& edges) const;
  double lengthOf(std::int32_t a, std::int32_t b) const
  {
    return (mesh_.points[b] - mesh_.points[a]).norm();
  }
  bool isOnSurface(const Edge& edge) const
  {
    return mesh_.onSurface[edge[0]] != 0 && mesh_.onSurface[edge[1]] != 0;
  }
  void placeCage(const PieceCage& cage, const std::vector<SkeletonAxis>& before);
  bool splitEdges();
  std::vector<Edge> newEdges();
  bool isOff(const Edge& edge, double value, double length) const;
  void addLongestEdges(std::vector<Edge>& split);
  void addMiddles(const std::vector<Edge>& edges);
  void addPoint(const Vec3& point, const Vec3& normal, bool onSurface);
  void divideTriangles();
  void divide(const Triangle& triangle, std::vector<Triangle>& result) const;
  std::int32_t middle(std::int32_t a, std::int32_t b) const { return middles_.at(keyOf(a, b)); }

  const FieldSource& field_;
  const PieceMeshOptions& options_;
  PieceMesh mesh_;
  std::vector<double> radii_;
  std::unordered_map<std::uint64_t, std::int32_t> middles_; // the vertex, or kSettled
};

void Refiner::addPoint(const Vec3& point, const Vec3& normal, bool onSurface)
{
  mesh_.points.push_back(point);
  mesh_.normals.push_back(normal);
  mesh_.onSurface.push_back(onSurface ? 1 : 0);
}

void Refiner::placeCage(const PieceCage& cage, const std::vector<SkeletonAxis>& before)
{
  std::vector<SkeletonAxis> axes = cage.axes;
  for (std::size_t k = 0; k < axes.size() && before.size() == axes.size(); ++k)
  {
    const bool isNear = (axes[k].base - before[k].base).norm() < kNearby * cage.radii[k] &&
      axes[k].direction.dot(before[k].direction) > 1.0 - kNearby;
    axes[k].start = isNear ? before[k].start : axes[k].start;
  }
  std::vector<Vec3> gradient;
  const std::vector<double> found = slideAxes(field_, axes, &gradient);
  for (std::size_t k = 0; k < axes.size(); ++k)
  {
    const bool isFound = !std::isnan(found[k]);
    // One that finds nothing ends inside of what it runs into.
    const double t = isFound ? found[k] : axes[k].most;
    const bool steep = isFound && gradient[k].norm() > 0.0;
    addPoint(axes[k].base + t * axes[k].direction,
      steep ? Vec3(-gradient[k].normalized()) : axes[k].direction, isFound);
    mesh_.bases.push_back(axes[k].base);
    axes[k].start = t;
  }
  mesh_.axes = std::move(axes);
}

std::vector<Edge> Refiner::newEdges()
{
  std::vector<Edge> edges;
  for (const Triangle& triangle : mesh_.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = triangle[k];
      const std::int32_t b = triangle[(k + 1) % 3];
      if (middles_.try_emplace(keyOf(a, b), kSettled).second)
      {
        edges.push_back({ a, b });
      }
    }
  }
  return edges;
}

bool Refiner::isOff(const Edge& edge, double value, double length) const
{
  const double radius = 0.5 * (radii_[edge[0]] + radii_[edge[1]]);
  if (length < kShortest * radius)
  {
    return false;
  }
  const double tolerance = options_.refinement * kThreshold;
  if (!isOnSurface(edge))
  {
    return value < kThreshold - tolerance; // what is inside may stay as it is
  }
  const bool isLong = options_.longestEdge > 0.0 && length > options_.longestEdge;
  return isLong || std::abs(value - kThreshold) > tolerance;
}

std::vector<Vec3> Refiner::middlesOf(const std::vector<Edge>& edges) const
{
  std::vector<Vec3> result;
  for (const auto& [a, b] : edges)
  {
    result.push_back(0.5 * (mesh_.points[a] + mesh_.points[b]));
  }
  return result;
}

/// \return whether any edge has a new vertex.
bool Refiner::splitEdges()
{
  const std::vector<Edge> edges = newEdges();
  const std::vector<double> value = fieldAt(field_, middlesOf(edges));
  std::vector<Edge> split;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const auto [a, b] = edges[k];
    if (isOff(edges[k], value[k], lengthOf(a, b)))
    {
      middles_[keyOf(a, b)] = kToSplit;
      split.push_back(edges[k]);
    }
  }
  addLongestEdges(split);
  requirePieceSize(double(mesh_.points.size() + split.size()));
  addMiddles(split);
  return !split.empty();
}

/// Of each triangle with an edge that is split, also the longest: otherwise it would stay, and
/// splits on both of its sides would come ever nearer to it.
void Refiner::addLongestEdges(std::vector<Edge>& split)
{
  const auto isSplit = [&](std::int32_t a, std::int32_t b)
  { return middles_[keyOf(a, b)] == kToSplit; };
  for (std::size_t before = 0; before < split.size();)
  {
    before = split.size();
    for (const Triangle& triangle : mesh_.triangles)
    {
      int longest = 0;
      double most = 0.0;
      bool any = false;
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t a = triangle[k];
        const std::int32_t b = triangle[(k + 1) % 3];
        const double length = lengthOf(a, b);
        longest = length > kClearly * most ? k : longest;
        most = std::max(most, length);
        any = any || isSplit(a, b);
      }
      const Edge edge{ triangle[longest], triangle[(longest + 1) % 3] };
      if (any && !isSplit(edge[0], edge[1]))
      {
        middles_[keyOf(edge[0], edge[1])] = kToSplit;
        split.push_back(edge);
      }
    }
  }
}

void Refiner::addMiddles(const std::vector<Edge>& edges)
{
  const std::vector<Vec3> middles = middlesOf(edges);
  std::vector<double> value;
  std::vector<Vec3> gradient;
  fieldAndGradientAt(field_, middles, value, gradient);
  std::vector<SkeletonAxis> axes;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const auto [a, b] = edges[k];
    const double steepness = gradient[k].norm();
    const Vec3 along = mesh_.normals[a] + mesh_.normals[b];
    const Vec3 outward = steepness > 0.0 ? Vec3(-gradient[k] / steepness) : along.normalized();
    // An edge that cuts through a body does not go around it: its middle stays inside.
    const bool cuts = value[k] > kThreshold &&
      (!isOnSurface(edges[k]) || mesh_.normals[a].dot(mesh_.normals[b]) < kOpposite);
    const double reach = cuts ? 0.0 : kReach * lengthOf(a, b);
    const double start = steepness > 0.0 ? (value[k] - kThreshold) / steepness : 0.0;
    axes.push_back({ middles[k], outward, start, -reach, reach, 0.5 * reach });
  }
  const std::vector<double> found = slideAxes(field_, axes, &gradient);
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const auto [a, b] = edges[k];
    const bool isFound = !std::isnan(found[k]);
    middles_[keyOf(a, b)] = std::int32_t(mesh_.points.size());
    const bool steep = isFound && gradient[k].norm() > 0.0;
    addPoint(axes[k].base + (isFound ? found[k] : 0.0) * axes[k].direction,
      steep ? Vec3(-gradient[k].normalized()) : axes[k].direction, isFound);
    mesh_.bases.push_back(0.5 * (mesh_.bases[a] + mesh_.bases[b]));
    radii_.push_back(0.5 * (radii_[a] + radii_[b]));
  }
}

void Refiner::divideTriangles()
{
  std::vector<Triangle> result;
  result.reserve(2 * mesh_.triangles.size());
  for (const Triangle& triangle : mesh_.triangles)
  {
    divide(triangle, result);
  }
  mesh_.triangles = std::move(result);
}

void Refiner::divide(const Triangle& triangle, std::vector<Triangle>& result) const
{
  std::array<std::int32_t, 3> at; // on the edge from a corner to the next
  int count = 0;
  for (int k = 0; k < 3; ++k)
  {
    at[k] = middle(triangle[k], triangle[(k + 1) % 3]);
    count += at[k] != kSettled ? 1 : 0;
  }
  if (count == 0)
  {
    result.push_back(triangle);
    return;
  }
  if (count == 3)
  {
    for (int k = 0; k < 3; ++k)
    {
      result.push_back({ triangle[k], at[k], at[(k + 2) % 3] });
    }
    result.push_back({ at[0], at[1], at[2] });
    return;
  }
  // Turned so that the only edge that is split, or the only one that is not, is the first.
  int first = 0;
  while ((at[first] != kSettled) != (count == 1))
  {
    ++first;
  }
  const std::int32_t a = triangle[first];
  const std::int32_t b = triangle[(first + 1) % 3];
  const std::int32_t c = triangle[(first + 2) % 3];
  if (count == 1)
  {
    const std::int32_t ab = at[first];
    result.push_back({ a, ab, c });
    result.push_back({ ab, b, c });
    return;
  }
  const std::int32_t bc = at[(first + 1) % 3];
  const std::int32_t ca = at[(first + 2) % 3];
  result.push_back({ bc, c, ca });
  const auto length = [&](std::int32_t p, std::int32_t q)
  { return (mesh_.points[p] - mesh_.points[q]).squaredNorm(); };
  if (kClearly * length(a, bc) < length(b, ca))
  {
    result.push_back({ a, b, bc });
    result.push_back({ a, bc, ca });
  }
  else
  {
    result.push_back({ a, b, ca });
    result.push_back({ b, bc, ca });
  }
}

} // namespace

void requirePieceSize(double vertices)
{
  if (vertices > kMaxPieceVertices)
  {
    throw TooLarge("The mesh around one piece of the skeleton would have more than " +
      std::to_string(std::int64_t(kMaxPieceVertices)) +
      " vertices: its radius is tiny beside its size, or Refinement too fine. Make the radius, "
      "Refinement or the edge length larger.");
  }
}

PieceMesh refineCage(const PieceCage& cage, const FieldSource& field,
  const PieceMeshOptions& options, const std::vector<SkeletonAxis>& before,
  const Progress& progress)
{
  return Refiner(cage, field, options).run(cage, before, progress);
}

} // namespace hybridtree
