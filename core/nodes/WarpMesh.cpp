// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/WarpMesh.h"

#include "core/base/Error.h"
#include "core/mesh/Remesh.h"
#include "core/mesh/SmoothNormals.h"
#include "core/nodes/SurfaceProjection.h"
#include "core/nodes/WarpImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 512;
constexpr double kLongEdge = 4.0 / 3.0; // edge lengths, as in remeshStretched
constexpr double kStretch = 1.1;        // of an edge, below which its length is its own affair
constexpr double kBow = 0.01;           // edge lengths between an edge's image and its chord
constexpr int kMaxRounds = 24;          // each halves every long edge

using Edge = std::array<std::int32_t, 2>;

Edge edgeOf(const Triangle& triangle, int side)
{
  const std::int32_t a = triangle[side];
  const std::int32_t b = triangle[(side + 1) % 3];
  return { std::min(a, b), std::max(a, b) };
}

// Splits the long edges of a mesh at their midpoints, where long is measured in the image under a
// warp. Keeps track of where the corners of each triangle lie on their source triangle, which the
// mesh itself only knows for one triangle around each point.
class StretchRefiner
{
public:
  StretchRefiner(TriangleMesh& mesh, const SpaceWarp& warp, double edgeLength, const Node& node,
    const Progress& progress)
    : mesh_(mesh)
    , warp_(warp)
    , node_(node)
    , edgeLength_(edgeLength)
    , progress_(progress)
    , image_(mesh.points)
    , leaf_(node.leafMesh())
    , fresh_(mesh.triangles.size())
  {
    mapForward(warp_, image_, 0, progress_);
    this->findCorners();
    std::iota(fresh_.begin(), fresh_.end(), std::size_t(0));
  }

  void run()
  {
    for (int round = 0; round < kMaxRounds; ++round)
    {
      const std::vector<Edge> edges = this->longEdges();
      if (edges.empty())
      {
        return;
      }
      this->addMidpoints(edges);
      this->splitTriangles(edges);
    }
  }

  std::vector<Vec3> takeImage() { return std::move(image_); }

private:
  using Corners = std::array<Eigen::Vector2d, 3>;

  void findCorners()
  {
    if (mesh_.sourceTriangle.empty() || mesh_.vertexOrigin.empty())
    {
      return;
    }
    corners_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        corners_[t][corner] = this->placeOn(mesh_.sourceTriangle[t], mesh_.triangles[t][corner]);
      }
    }
  }

  // Where a point lies on a source triangle, by weights of its second and third corner; NaN where
  // the mesh does not tell.
  Eigen::Vector2d placeOn(std::int32_t source, std::int32_t point) const
  {
    const VertexOrigin& origin = mesh_.vertexOrigin[point];
    if (source >= 0 && origin.triangle == source)
    {
      return { origin.u, origin.v };
    }
    if (source >= 0 && leaf_ && leaf_->points.size() == mesh_.points.size())
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

  std::vector<Edge> longEdges() const
  {
    const double limit = kLongEdge * edgeLength_;
    std::vector<Edge> edges;
    for (const std::size_t t : fresh_)
    {
      this->lookForStop(t);
      for (int side = 0; side < 3; ++side)
      {
        const Edge edge = edgeOf(mesh_.triangles[t], side);
        if ((image_[edge[0]] - image_[edge[1]]).squaredNorm() > limit * limit)
        {
          edges.push_back(edge);
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return this->deformedOf(edges);
  }

  // Those that the warp lengthens or bows; a leaf's own long edges stay where it does neither.
  std::vector<Edge> deformedOf(const std::vector<Edge>& edges) const
  {
    std::vector<Vec3> quarters; // three on each edge: an S-shaped image crosses its chord
    quarters.reserve(3 * edges.size());
    for (const Edge& edge : edges)
    {
      for (const double at : { 0.25, 0.5, 0.75 })
      {
        quarters.push_back((1.0 - at) * mesh_.points[edge[0]] + at * mesh_.points[edge[1]]);
      }
    }
    mapForward(warp_, quarters, 0, progress_);
    std::vector<Edge> result;
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      const Vec3& a = image_[edges[k][0]];
      const Vec3& b = image_[edges[k][1]];
      const double bow = std::max({ (quarters[3 * k] - 0.75 * a - 0.25 * b).norm(),
        (quarters[3 * k + 1] - 0.5 * (a + b)).norm(),
        (quarters[3 * k + 2] - 0.25 * a - 0.75 * b).norm() });
      const double before = (mesh_.points[edges[k][0]] - mesh_.points[edges[k][1]]).norm();
      if (bow > kBow * edgeLength_ || (a - b).norm() > kStretch * before)
      {
        result.push_back(edges[k]);
      }
    }
    return result;
  }

  void addMidpoints(const std::vector<Edge>& edges)
  {
    const std::size_t first = mesh_.points.size();
    std::vector<Vec3> points;
    std::vector<Vec3> normals;
    double longest = 0.0;
    for (const Edge& edge : edges)
    {
      const Vec3& a = mesh_.points[edge[0]];
      const Vec3& b = mesh_.points[edge[1]];
      points.push_back(0.5 * (a + b));
      longest = std::max(longest, (a - b).norm());
      if (!mesh_.normals.empty())
      {
        normals.push_back((mesh_.normals[edge[0]] + mesh_.normals[edge[1]]).stableNormalized());
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

  void splitTriangles(const std::vector<Edge>& edges)
  {
    const std::int32_t first = static_cast<std::int32_t>(mesh_.points.size() - edges.size());
    std::vector<std::size_t> split;
    std::size_t made = mesh_.triangles.size();
    for (const std::size_t t : fresh_)
    {
      this->lookForStop(t);
      std::array<std::int32_t, 3> middle{ -1, -1, -1 };
      for (int side = 0; side < 3; ++side)
      {
        const Edge edge = edgeOf(mesh_.triangles[t], side);
        const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
        if (found != edges.end() && *found == edge)
        {
          middle[side] = first + static_cast<std::int32_t>(found - edges.begin());
        }
      }
      if (middle != std::array<std::int32_t, 3>{ -1, -1, -1 })
      {
        this->splitTriangle(t, middle);
        split.push_back(t);
      }
    }
    for (; made < mesh_.triangles.size(); ++made)
    {
      split.push_back(made);
    }
    fresh_ = std::move(split);
  }

  void lookForStop(std::size_t step) const
  {
    if (step % kGrain == 0)
    {
      progress_.check();
    }
  }

  // Corners 0 to 2 of a split triangle are its own, 3 to 5 the midpoints of its sides.
  void splitTriangle(std::size_t t, const std::array<std::int32_t, 3>& middle)
  {
    const Triangle corner = mesh_.triangles[t];
    const std::array<std::int32_t, 6> point{ corner[0], corner[1], corner[2], middle[0], middle[1],
      middle[2] };
    std::array<Eigen::Vector2d, 6> place;
    if (!corners_.empty())
    {
      for (int side = 0; side < 3; ++side)
      {
        place[side] = corners_[t][side];
        place[3 + side] = 0.5 * (corners_[t][side] + corners_[t][(side + 1) % 3]);
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

  // The triangles that cover one whose sides with a midpoint >= 0 are split.
  std::vector<std::array<int, 3>> pattern(const std::array<std::int32_t, 6>& point) const
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

  void recordOrigin(std::size_t t, std::int32_t point, const Eigen::Vector2d& place)
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

  void replaceTriangle(std::size_t t, const Triangle& made, const Corners& places)
  {
    mesh_.triangles[t] = made;
    if (!corners_.empty())
    {
      corners_[t] = places;
    }
  }

  void appendTriangle(std::size_t t, const Triangle& made, const Corners& places)
  {
    mesh_.triangles.push_back(made);
    if (!corners_.empty())
    {
      corners_.push_back(places);
    }
    for (std::vector<std::int32_t>* source : { &mesh_.sourceLeaf, &mesh_.sourceTriangle })
    {
      if (!source->empty())
      {
        const std::int32_t value = (*source)[t];
        source->push_back(value);
      }
    }
  }

  TriangleMesh& mesh_;
  const SpaceWarp& warp_;
  const Node& node_;
  double edgeLength_;
  const Progress& progress_;
  std::vector<Vec3> image_;
  MeshPtr leaf_;
  // Triangles of the last round. Points never move, so what was left in one round is left in the
  // next: only they can have edges to split.
  std::vector<std::size_t> fresh_;
  std::vector<Corners> corners_; // per triangle, empty without provenance
};

void turnInsideOut(TriangleMesh& mesh)
{
  for (Triangle& triangle : mesh.triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
}

double sideLength(const std::vector<Vec3>& points, const Triangle& triangle, int side)
{
  return (points[triangle[side]] - points[triangle[(side + 1) % 3]]).norm();
}

// Height over the longest side, over that side: 0 for a sliver, 0.87 for an equal-sided triangle.
double flatness(const std::vector<Vec3>& points, const Triangle& t)
{
  const double longest =
    std::max({ sideLength(points, t, 0), sideLength(points, t, 1), sideLength(points, t, 2) });
  const double twiceArea = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
  return longest > 0.0 ? twiceArea / (longest * longest) : 0.0;
}

// Whether the deformation has made any triangle clearly worse, and bad: slivers that a mesh leaf
// came with are its own.
bool hasBadNewShapes(const TriangleMesh& before, const std::vector<Vec3>& after)
{
  constexpr double kBad = 0.3;
  constexpr double kWorse = 0.8;
  return std::any_of(before.triangles.begin(), before.triangles.end(),
    [&](const Triangle& triangle)
    {
      const double now = flatness(after, triangle);
      return now < kBad && now < kWorse * flatness(before.points, triangle);
    });
}

// Collapses and flips what the deformation has squeezed. Edges that are long still are so because
// the deformation leaves them straight: they stay.
void mendShapes(TriangleMesh& mesh, double edgeLength, const Progress& progress)
{
  double longest = edgeLength;
  for (const Triangle& triangle : mesh.triangles)
  {
    for (int side = 0; side < 3; ++side)
    {
      longest = std::max(longest, sideLength(mesh.points, triangle, side) / kLongEdge);
    }
  }
  longest *= 1.0 + 1e-9; // the longest edge itself is not to be split by rounding
  RemeshOptions options;
  options.shortEdge *= edgeLength / longest;
  options.edgeLength = longest;
  remeshStretched(mesh, options, nullptr, progress);
}

} // namespace

std::vector<Vec3> pointNormals(const TriangleMesh& mesh)
{
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 normal = areaNormal(mesh, t);
    for (const std::int32_t point : mesh.triangles[t])
    {
      normals[point] += normal;
    }
  }
  for (Vec3& normal : normals)
  {
    normal.stableNormalize();
  }
  return normals;
}

TriangleMesh warpedMesh(const TriangleMesh& mesh, const SpaceWarp& warp, double edgeLength,
  const Node& node, const Progress& progress)
{
  requireCountableImage(mesh, warp, edgeLength, progress);
  TriangleMesh result = mesh;
  StretchRefiner refiner(result, warp, edgeLength, node, progress);
  refiner.run();
  progress.report(0.5);
  const double volume = signedVolume(result);
  if (!result.normals.empty())
  {
    mapNormals(warp, result.points, result.normals);
  }
  const std::vector<Vec3> image = refiner.takeImage();
  const bool mend = hasBadNewShapes(result, image);
  result.points = image;
  if (volume * signedVolume(result) < 0.0)
  {
    turnInsideOut(result);
  }
  if (mend)
  {
    mendShapes(result, edgeLength, ProgressPart(progress, 0.5, 1.0));
  }
  if (result.normals.size() != result.points.size())
  {
    result.normals = pointNormals(result);
  }
  else if (node.isFaceted() && result.points.size() != mesh.points.size())
  {
    // New points have the normal of one facet, beside old ones with that of the mesh.
    SmoothNormalsOptions options;
    options.rounds = 1;
    smoothNormals(result, options);
  }
  return result;
}

} // namespace hybridtree
