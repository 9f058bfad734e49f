// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceMesh.h"

#include "core/base/Error.h"
#include "core/subdivision/EdgeMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace hybridtree
{
namespace
{

constexpr int kMaxRounds = 30;
constexpr double kShortest = 0.1;    // edge that may be split, in radii
constexpr double kReach = 0.4;       // of the middle of an edge to the surface, in edge lengths
constexpr double kOpposite = -0.2;   // cosine between the normals at both ends of an edge that cuts
constexpr double kClearly = 1.00001; // so that rounding does not choose between equal edges

using Edge = EdgeMesh::Edge;

class Refiner
{
public:
  Refiner(const PieceCage& cage, const PlacedField& field, const PieceMeshOptions& options)
    : field_(field), options_(options), radii_(cage.radii), parts_(cage.triangles, cage.elements)
  {
  }

  PieceMesh run(const PieceCage& cage, const Progress& progress)
  {
    placeCage(cage);
    for (int round = 0; round < kMaxRounds && splitEdges(); ++round)
    {
      progress.check();
      parts_.divide(mesh_.points);
    }
    mesh_.triangles = parts_.triangles();
    return std::move(mesh_);
  }

private:
  const Edge& edge(std::int32_t number) const { return parts_.edges()[std::size_t(number)]; }
  std::vector<PlacedPoint> middlesOf(const std::vector<std::int32_t>& edges) const;
  bool isOnSurface(const Edge& edge) const
  {
    return mesh_.onSurface[edge.a] != 0 && mesh_.onSurface[edge.b] != 0;
  }
  bool isShort(std::int32_t number) const
  {
    return lengths_[number] < kShortest * 0.5 * (radii_[edge(number).a] + radii_[edge(number).b]);
  }
  bool isLong(std::int32_t number) const
  {
    return isOnSurface(edge(number)) && options_.longestEdge > 0.0 &&
      lengths_[number] > options_.longestEdge;
  }
  void placeCage(const PieceCage& cage);
  bool splitEdges();
  std::vector<std::int32_t> newEdges();
  bool isOff(const Edge& edge, double value) const;
  void addLongestEdges(std::vector<std::int32_t>& split);
  void addMiddles(const std::vector<std::int32_t>& edges);
  void addPoint(const Vec3& point, const Vec3& normal, bool onSurface);

  const PlacedField& field_;
  const PieceMeshOptions& options_;
  PieceMesh mesh_;
  std::vector<double> radii_;
  EdgeMesh parts_;
  std::vector<double> lengths_;        // per edge
  std::vector<char> isSplit_;          // per edge
  std::vector<std::size_t> untouched_; // triangles without an edge that is split
};

void Refiner::addPoint(const Vec3& point, const Vec3& normal, bool onSurface)
{
  mesh_.points.push_back(point);
  mesh_.normals.push_back(normal);
  mesh_.onSurface.push_back(onSurface ? 1 : 0);
}

void Refiner::placeCage(const PieceCage& cage)
{
  const std::vector<SkeletonAxis>& axes = cage.axes;
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
    mesh_.elements.push_back(axes[k].element);
  }
}

/// Those that were not there before.
std::vector<std::int32_t> Refiner::newEdges()
{
  std::vector<std::int32_t> edges;
  edges.reserve(parts_.edges().size() - lengths_.size());
  for (std::size_t k = lengths_.size(); k < parts_.edges().size(); ++k)
  {
    const Edge& edge = parts_.edges()[k];
    lengths_.push_back((mesh_.points[edge.b] - mesh_.points[edge.a]).norm());
    edges.push_back(std::int32_t(k));
  }
  isSplit_.resize(lengths_.size(), 0);
  return edges;
}

/// \param value at the middle.
bool Refiner::isOff(const Edge& edge, double value) const
{
  const double tolerance = options_.refinement * kThreshold;
  return isOnSurface(edge) ? std::abs(value - kThreshold) > tolerance
                           : value < kThreshold - tolerance; // what is inside may stay as it is
}

std::vector<PlacedPoint> Refiner::middlesOf(const std::vector<std::int32_t>& edges) const
{
  std::vector<PlacedPoint> result;
  result.reserve(edges.size());
  for (const std::int32_t number : edges)
  {
    const Edge& of = edge(number);
    result.push_back({ 0.5 * (mesh_.points[of.a] + mesh_.points[of.b]), of.element });
  }
  return result;
}

/// \return whether any edge has a new vertex.
bool Refiner::splitEdges()
{
  std::vector<std::int32_t> asked; // the length does not tell
  std::vector<std::int32_t> split;
  for (const std::int32_t number : newEdges())
  {
    if (!isShort(number))
    {
      (isLong(number) ? split : asked).push_back(number);
    }
  }
  const std::vector<double> value = fieldAt(field_, middlesOf(asked));
  for (std::size_t k = 0; k < asked.size(); ++k)
  {
    if (isOff(edge(asked[k]), value[k]))
    {
      split.push_back(asked[k]);
    }
  }
  std::sort(split.begin(), split.end());
  for (const std::int32_t number : split)
  {
    isSplit_[number] = 1;
  }
  addLongestEdges(split);
  requirePieceSize(double(mesh_.points.size() + split.size()));
  addMiddles(split);
  return !split.empty();
}

/// Of each triangle with an edge that is split, also the longest: otherwise it would stay, and
/// splits on both of its sides would come ever nearer to it.
void Refiner::addLongestEdges(std::vector<std::int32_t>& split)
{
  untouched_.resize(parts_.edgesOf().size());
  std::iota(untouched_.begin(), untouched_.end(), std::size_t(0));
  for (std::size_t before = 0; before < split.size();)
  {
    before = split.size();
    std::size_t left = 0;
    for (const std::size_t triangle : untouched_)
    {
      const std::array<std::int32_t, 3>& edges = parts_.edgesOf()[triangle];
      if (!(isSplit_[edges[0]] | isSplit_[edges[1]] | isSplit_[edges[2]]))
      {
        untouched_[left++] = triangle;
        continue;
      }
      std::int32_t longest = edges[0];
      longest = lengths_[edges[1]] > kClearly * lengths_[longest] ? edges[1] : longest;
      longest = lengths_[edges[2]] > kClearly * lengths_[longest] ? edges[2] : longest;
      if (!isSplit_[longest])
      {
        isSplit_[longest] = 1;
        split.push_back(longest);
      }
    }
    untouched_.resize(left);
  }
}

void Refiner::addMiddles(const std::vector<std::int32_t>& edges)
{
  const std::vector<PlacedPoint> middles = middlesOf(edges);
  std::vector<Vec3> gradient;
  const std::vector<double> value = fieldAt(field_, middles, &gradient);
  std::vector<SkeletonAxis> axes;
  axes.reserve(edges.size());
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const Edge& of = edge(edges[k]);
    const double steepness = gradient[k].norm();
    const Vec3 along = mesh_.normals[of.a] + mesh_.normals[of.b];
    const Vec3 outward = steepness > 0.0 ? Vec3(-gradient[k] / steepness) : along.normalized();
    // An edge that cuts through a body does not go around it: its middle stays inside.
    const bool cuts = value[k] > kThreshold &&
      (!isOnSurface(of) || mesh_.normals[of.a].dot(mesh_.normals[of.b]) < kOpposite);
    const double reach = cuts ? 0.0 : kReach * lengths_[edges[k]];
    const double start = steepness > 0.0 ? (value[k] - kThreshold) / steepness : 0.0;
    axes.push_back({ middles[k].at, outward, start, -reach, reach, 0.5 * reach, of.element,
      steepness > 0.0 ? value[k] : std::numeric_limits<double>::quiet_NaN(), -steepness });
  }
  const std::vector<double> found = slideAxes(field_, axes, &gradient);
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const Edge of = edge(edges[k]);
    const bool isFound = !std::isnan(found[k]);
    parts_.split(edges[k], std::int32_t(mesh_.points.size()));
    const bool steep = isFound && gradient[k].norm() > 0.0;
    addPoint(axes[k].base + (isFound ? found[k] : 0.0) * axes[k].direction,
      steep ? Vec3(-gradient[k].normalized()) : axes[k].direction, isFound);
    mesh_.bases.push_back(0.5 * (mesh_.bases[of.a] + mesh_.bases[of.b]));
    mesh_.elements.push_back(of.element);
    radii_.push_back(0.5 * (radii_[of.a] + radii_[of.b]));
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

PieceMesh refineCage(const PieceCage& cage, const PlacedField& field,
  const PieceMeshOptions& options, const Progress& progress)
{
  return Refiner(cage, field, options).run(cage, progress);
}

} // namespace hybridtree
