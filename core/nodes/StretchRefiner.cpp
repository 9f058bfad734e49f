// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/StretchRefiner.h"

#include "core/base/Parallel.h"
#include "core/nodes/SurfaceProjection.h"
#include "core/nodes/WarpImage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 2048;
constexpr std::size_t kStepsPerLook = 512;
constexpr double kLongEdge = 4.0 / 3.0; // edge lengths, as in remeshStretched
constexpr double kStretch = 1.1;        // of an edge, below which its length is its own affair
constexpr double kBow = 0.01;           // edge lengths between an edge's image and its chord
constexpr int kMaxRounds = 24;          // each halves every long edge

} // namespace

StretchRefiner::StretchRefiner(TriangleMesh& mesh, std::vector<Vec3> image, const SpaceWarp& warp,
  double edgeLength, const Node& node, const Progress& progress)
  : mesh_(mesh)
  , image_(std::move(image))
  , warp_(warp)
  , node_(node)
  , longSquared_(kLongEdge * edgeLength * (kLongEdge * edgeLength))
  , bow_(kBow * edgeLength)
  , progress_(progress)
  , leaf_(node.leafMesh())
  , isLeaf_(leaf_ && leaf_->points.size() == mesh.points.size())
{
}

void StretchRefiner::run()
{
  for (int round = 0; round < kMaxRounds; ++round)
  {
    this->findLong();
    const std::vector<Edge> edges = this->deformedOf(edges_);
    if (edges.empty())
    {
      return;
    }
    this->addMidpoints(edges);
    this->splitTriangles(edges);
  }
}

StretchRefiner::Edge StretchRefiner::edgeOf(const Triangle& triangle, int side)
{
  const auto [low, high] = std::minmax({ triangle[side], triangle[(side + 1) % 3] });
  return static_cast<Edge>(low) << 32 | static_cast<Edge>(high);
}

bool StretchRefiner::isLong(Edge edge) const
{
  return (image_[firstOf(edge)] - image_[secondOf(edge)]).squaredNorm() > longSquared_;
}

void StretchRefiner::findLong()
{
  struct Found
  {
    std::vector<std::size_t> triangles;
    std::vector<Edge> edges;
  };
  const std::size_t count = allAreFresh_ ? mesh_.triangles.size() : fresh_.size();
  std::vector<Found> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress_.check();
      Found& found = parts[begin / kGrain];
      for (std::size_t k = begin; k < end; ++k)
      {
        const std::size_t t = allAreFresh_ ? k : fresh_[k];
        const std::size_t before = found.edges.size();
        for (int side = 0; side < 3; ++side)
        {
          const Edge edge = edgeOf(mesh_.triangles[t], side);
          if (this->isLong(edge))
          {
            found.edges.push_back(edge);
          }
        }
        if (found.edges.size() > before)
        {
          found.triangles.push_back(t);
        }
      }
    });
  triangles_.clear();
  edges_.clear();
  for (const Found& found : parts)
  {
    triangles_.insert(triangles_.end(), found.triangles.begin(), found.triangles.end());
    edges_.insert(edges_.end(), found.edges.begin(), found.edges.end());
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

/// Those that the warp lengthens or bows; a leaf's own long edges stay where it does neither.
std::vector<StretchRefiner::Edge> StretchRefiner::deformedOf(const std::vector<Edge>& edges) const
{
  std::vector<char> deformed(edges.size());
  std::vector<Edge> kept; // their length
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const std::int32_t a = firstOf(edges[k]);
    const std::int32_t b = secondOf(edges[k]);
    deformed[k] =
      (image_[a] - image_[b]).norm() > kStretch * (mesh_.points[a] - mesh_.points[b]).norm();
    if (!deformed[k])
    {
      kept.push_back(edges[k]);
    }
  }
  const std::vector<char> bowed = this->areBowed(kept);
  std::vector<Edge> result;
  for (std::size_t k = 0, next = 0; k < edges.size(); ++k)
  {
    if (deformed[k] || bowed[next++])
    {
      result.push_back(edges[k]);
    }
  }
  return result;
}

std::vector<char> StretchRefiner::areBowed(const std::vector<Edge>& edges) const
{
  std::vector<Vec3> quarters; // three on each edge: an S-shaped image crosses its chord
  quarters.reserve(3 * edges.size());
  for (const Edge edge : edges)
  {
    for (const double at : { 0.25, 0.5, 0.75 })
    {
      quarters.push_back(
        (1.0 - at) * mesh_.points[firstOf(edge)] + at * mesh_.points[secondOf(edge)]);
    }
  }
  mapForward(warp_, quarters, 0, progress_);
  std::vector<char> bowed(edges.size());
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const Vec3& a = image_[firstOf(edges[k])];
    const Vec3& b = image_[secondOf(edges[k])];
    bowed[k] = std::max({ (quarters[3 * k] - 0.75 * a - 0.25 * b).norm(),
                 (quarters[3 * k + 1] - 0.5 * (a + b)).norm(),
                 (quarters[3 * k + 2] - 0.25 * a - 0.75 * b).norm() }) > bow_;
  }
  return bowed;
}

void StretchRefiner::addMidpoints(const std::vector<Edge>& edges)
{
  const std::size_t first = mesh_.points.size();
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  double longest = 0.0;
  for (const Edge edge : edges)
  {
    const Vec3& a = mesh_.points[firstOf(edge)];
    const Vec3& b = mesh_.points[secondOf(edge)];
    points.push_back(0.5 * (a + b));
    longest = std::max(longest, (a - b).norm());
    if (!mesh_.normals.empty())
    {
      normals.push_back(
        (mesh_.normals[firstOf(edge)] + mesh_.normals[secondOf(edge)]).stableNormalized());
    }
  }
  if (mesh_.sourceTriangle.empty()) // else they already are where they belong: on the leaf
  {
    projectOntoSurface(node_, 0.25 * longest, points, normals, progress_);
  }
  mesh_.points.insert(mesh_.points.end(), points.begin(), points.end());
  mesh_.normals.insert(mesh_.normals.end(), normals.begin(), normals.end());
  if (!mesh_.vertexOrigin.empty())
  {
    mesh_.vertexOrigin.resize(mesh_.points.size());
  }
  image_.insert(image_.end(), points.begin(), points.end());
  mapForward(warp_, image_, first, progress_);
}

void StretchRefiner::splitTriangles(const std::vector<Edge>& edges)
{
  const std::int32_t first = static_cast<std::int32_t>(mesh_.points.size() - edges.size());
  std::size_t made = mesh_.triangles.size();
  fresh_.clear();
  allAreFresh_ = false;
  std::size_t step = 0;
  for (const std::size_t t : triangles_)
  {
    if (step++ % kStepsPerLook == 0)
    {
      progress_.check();
    }
    std::array<std::int32_t, 3> middle{ -1, -1, -1 };
    for (int side = 0; side < 3; ++side)
    {
      const Edge edge = edgeOf(mesh_.triangles[t], side);
      if (!this->isLong(edge))
      {
        continue;
      }
      const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
      if (found != edges.end() && *found == edge)
      {
        middle[side] = first + static_cast<std::int32_t>(found - edges.begin());
      }
    }
    if (middle != std::array<std::int32_t, 3>{ -1, -1, -1 })
    {
      this->splitTriangle(t, middle);
      fresh_.push_back(t);
    }
  }
  for (; made < mesh_.triangles.size(); ++made)
  {
    fresh_.push_back(made);
  }
}

/// Corners 0 to 2 of a split triangle are its own, 3 to 5 the midpoints of its sides.
void StretchRefiner::splitTriangle(std::size_t t, const std::array<std::int32_t, 3>& middle)
{
  const Triangle corner = mesh_.triangles[t];
  const std::array<std::int32_t, 6> point{ corner[0], corner[1], corner[2], middle[0], middle[1],
    middle[2] };
  std::array<Eigen::Vector2d, 6> place;
  if (this->hasPlaces())
  {
    const Corners corners = this->cornersOf(t);
    for (int side = 0; side < 3; ++side)
    {
      place[side] = corners[side];
      place[3 + side] = 0.5 * (corners[side] + corners[(side + 1) % 3]);
      this->recordOrigin(t, middle[side], place[3 + side]);
    }
  }
  bool replaced = false;
  for (const std::array<int, 3>& part : this->pattern(point))
  {
    const Triangle made{ point[part[0]], point[part[1]], point[part[2]] };
    const Corners places{ place[part[0]], place[part[1]], place[part[2]] };
    replaced ? this->appendTriangle(t, made, places) : this->replaceTriangle(t, made, places);
    replaced = true;
  }
}

/// The triangles that cover one whose sides with a midpoint >= 0 are split.
std::vector<std::array<int, 3>> StretchRefiner::pattern(
  const std::array<std::int32_t, 6>& point) const
{
  const int split = (point[3] >= 0) + (point[4] >= 0) + (point[5] >= 0);
  if (split == 3)
  {
    return { { 3, 4, 5 }, { 0, 3, 5 }, { 3, 1, 4 }, { 5, 4, 2 } };
  }
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    if (split == 1 && point[3 + a] >= 0)
    {
      return { { a, 3 + a, c }, { 3 + a, b, c } };
    }
    if (split == 2 && point[3 + c] < 0) // sides ab and bc are split: corner b comes off
    {
      const bool fromA = (image_[point[a]] - image_[point[3 + b]]).squaredNorm() <
        (image_[point[c]] - image_[point[3 + a]]).squaredNorm();
      return fromA ? std::vector<std::array<int, 3>>{ { 3 + a, b, 3 + b }, { a, 3 + a, 3 + b },
        { a, 3 + b, c } }
                   : std::vector<std::array<int, 3>>{ { 3 + a, b, 3 + b }, { a, 3 + a, c },
                       { 3 + a, 3 + b, c } };
    }
  }
  return {};
}

StretchRefiner::Corners StretchRefiner::cornersOf(std::size_t t) const
{
  const auto known = corners_.find(t);
  if (known != corners_.end())
  {
    return known->second;
  }
  Corners corners;
  for (int corner = 0; corner < 3; ++corner)
  {
    corners[corner] = this->placeOn(mesh_.sourceTriangle[t], mesh_.triangles[t][corner]);
  }
  return corners;
}

/// Where a point of the mesh as it came lies on a source triangle, by weights of its second and
/// third corner; NaN where the mesh does not tell.
Eigen::Vector2d StretchRefiner::placeOn(std::int32_t source, std::int32_t point) const
{
  const VertexOrigin& origin = mesh_.vertexOrigin[point];
  if (source >= 0 && origin.triangle == source)
  {
    return { origin.u, origin.v };
  }
  if (source >= 0 && isLeaf_)
  {
    const Triangle& corners = leaf_->triangles[source];
    for (int corner = 0; corner < 3; ++corner)
    {
      if (corners[corner] == point)
      {
        return { corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0 };
      }
    }
  }
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

void StretchRefiner::recordOrigin(std::size_t t, std::int32_t point, const Eigen::Vector2d& place)
{
  if (point < 0 || !place.allFinite())
  {
    return;
  }
  VertexOrigin& origin = mesh_.vertexOrigin[point];
  if (origin.leaf < 0)
  {
    origin = { mesh_.sourceLeaf.empty() ? 0 : mesh_.sourceLeaf[t], mesh_.sourceTriangle[t],
      place[0], place[1] };
  }
}

void StretchRefiner::replaceTriangle(std::size_t t, const Triangle& made, const Corners& places)
{
  mesh_.triangles[t] = made;
  if (this->hasPlaces())
  {
    corners_[t] = places;
  }
}

void StretchRefiner::appendTriangle(std::size_t t, const Triangle& made, const Corners& places)
{
  if (this->hasPlaces())
  {
    corners_[mesh_.triangles.size()] = places;
  }
  mesh_.triangles.push_back(made);
  for (std::vector<std::int32_t>* source : { &mesh_.sourceLeaf, &mesh_.sourceTriangle })
  {
    if (!source->empty())
    {
      const std::int32_t value = (*source)[t];
      source->push_back(value);
    }
  }
}

} // namespace hybridtree
