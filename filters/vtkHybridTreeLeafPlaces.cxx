// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeLeafPlaces.h"

#include "core/mesh/MeshDistance.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <unordered_set>

namespace hybridtree
{
namespace
{

/// A mesh leaf that stands where the whole tree has it, but for its map.
struct Reach
{
  const Node* leaf;
  std::int32_t index;
};

/// Trees of very many leaves are not walked: each would be asked about every point.
constexpr int kMostLeaves = 10000;

bool keepsPlaces(const Node& node)
{
  const char* const kind = node.kind();
  return std::strcmp(kind, "blend") == 0 || std::strcmp(kind, "localBlend") == 0 ||
    std::strcmp(kind, "boolean") == 0;
}

void gather(const Node& node, std::int32_t first, std::vector<Reach>& found)
{
  if (node.leafMesh())
  {
    found.push_back({ &node, first });
  }
  if (keepsPlaces(node))
  {
    for (const NodePtr& child : node.children())
    {
      gather(*child, first, found);
      first += child->leafCount();
    }
  }
}

/// Some points, by coordinate.
class Points
{
public:
  void add(const Vec3& p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      coordinates_[axis].push_back(p[axis]);
    }
  }
  std::size_t size() const { return coordinates_[0].size(); }
  PointBatch batch() const
  {
    return { coordinates_[0].data(), coordinates_[1].data(), coordinates_[2].data(), this->size() };
  }
  VectorBatch vectors()
  {
    return { coordinates_[0].data(), coordinates_[1].data(), coordinates_[2].data() };
  }

private:
  std::vector<double> coordinates_[3];
};

/// Finds the leaf of the largest field, then the place on it.
class Nearest
{
public:
  explicit Nearest(const std::vector<Vec3>& points)
    : points_(points), field_(points.size(), 0.0), best_(points.size(), -1)
  {
  }

  void compare(const std::vector<Reach>& leaves)
  {
    for (std::size_t k = 0; k < leaves.size(); ++k)
    {
      const Box3 box = leaves[k].leaf->influenceBounds();
      const std::vector<std::size_t> inside =
        this->where([&](std::size_t point) { return box.contains(points_[point]); });
      Points some;
      for (const std::size_t point : inside)
      {
        some.add(points_[point]);
      }
      std::vector<double> field(some.size());
      leaves[k].leaf->field(some.batch(), field.data());
      for (std::size_t at = 0; at < inside.size(); ++at)
      {
        if (field[at] > field_[inside[at]])
        {
          field_[inside[at]] = field[at];
          best_[inside[at]] = std::int32_t(k);
        }
      }
    }
  }

  std::vector<VertexOrigin> places(const std::vector<Reach>& leaves) const
  {
    std::vector<VertexOrigin> found(points_.size());
    for (std::size_t k = 0; k < leaves.size(); ++k)
    {
      const std::vector<std::size_t> own =
        this->where([&](std::size_t point) { return best_[point] == std::int32_t(k); });
      if (!own.empty())
      {
        this->place(leaves[k], own, found);
      }
    }
    return found;
  }

private:
  template <class Test>
  std::vector<std::size_t> where(const Test& test) const
  {
    std::vector<std::size_t> found;
    for (std::size_t point = 0; point < points_.size(); ++point)
    {
      if (test(point))
      {
        found.push_back(point);
      }
    }
    return found;
  }

  void place(
    const Reach& reach, const std::vector<std::size_t>& own, std::vector<VertexOrigin>& found) const
  {
    const MeshPtr mesh = reach.leaf->leafMesh();
    const Affine3 back = reach.leaf->parameters().getAffine("map").inverse();
    Points here;
    for (const std::size_t point : own)
    {
      here.add(back * points_[point]);
    }
    Points nearest = here;
    std::vector<double> distance(own.size());
    std::vector<std::int32_t> triangle(own.size());
    sharedMeshDistance(mesh)->nearest(here.batch(), std::numeric_limits<double>::infinity(),
      distance.data(), triangle.data(), nearest.vectors());
    for (std::size_t at = 0; at < own.size(); ++at)
    {
      if (triangle[at] >= 0)
      {
        found[own[at]] = placeIn(*mesh, triangle[at], nearest.batch()[at]);
        found[own[at]].leaf = reach.index;
      }
    }
  }

  /// By the areas opposite its corners. \pre p lies in the triangle.
  static VertexOrigin placeIn(const TriangleMesh& mesh, std::int32_t triangle, const Vec3& p)
  {
    const Triangle& corner = mesh.triangles[std::size_t(triangle)];
    const Vec3& a = mesh.points[std::size_t(corner[0])];
    const Vec3 ab = mesh.points[std::size_t(corner[1])] - a;
    const Vec3 ac = mesh.points[std::size_t(corner[2])] - a;
    const Vec3 normal = ab.cross(ac);
    const double u = (p - a).cross(ac).dot(normal) / normal.squaredNorm();
    const double v = ab.cross(p - a).dot(normal) / normal.squaredNorm();
    return { -1, triangle, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0) };
  }

  const std::vector<Vec3>& points_;
  std::vector<double> field_;      ///< the largest so far, above 0
  std::vector<std::int32_t> best_; ///< whose it is
};

bool isPlace(const VertexOrigin& origin)
{
  return origin.leaf >= 0 && origin.triangle >= 0;
}

/// Gives places to those that are wanted and have none; `at` tells where they are.
template <class At>
void complete(const std::vector<Reach>& leaves, const std::vector<char>& wanted, const At& at,
  std::vector<VertexOrigin>& origins)
{
  std::vector<std::size_t> open;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < origins.size(); ++k)
  {
    if (wanted[k] && !isPlace(origins[k]))
    {
      open.push_back(k);
      points.push_back(at(k));
    }
  }
  Nearest nearest(points);
  nearest.compare(leaves);
  const std::vector<VertexOrigin> found = nearest.places(leaves);
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    origins[open[k]] = found[k];
  }
}

} // namespace

LeafPlacesOfMesh placesOnLeaves(const Node& tree, const TriangleMesh& mesh)
{
  LeafPlacesOfMesh places;
  places.points = mesh.vertexOrigin;
  places.points.resize(mesh.points.size());
  places.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.sourceTriangle.size(); ++t)
  {
    places.triangles[t] = { mesh.sourceLeaf[t], mesh.sourceTriangle[t], 0.0, 0.0 };
  }
  std::vector<Reach> leaves;
  if (tree.leafCount() <= kMostLeaves)
  {
    gather(tree, 0, leaves);
  }
  // Faces that are a primitive's alone, as those of a cut, are nobody else's.
  std::unordered_set<std::int32_t> ofMesh;
  for (const Reach& reach : leaves)
  {
    ofMesh.insert(reach.index);
  }
  std::vector<char> isShared(mesh.triangles.size(), 1);
  std::vector<char> hasShared(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const std::int32_t leaf = mesh.sourceLeaf.empty() ? -1 : mesh.sourceLeaf[t];
    isShared[t] = leaf < 0 || ofMesh.count(leaf) > 0;
    for (const std::int32_t corner : mesh.triangles[t])
    {
      hasShared[std::size_t(corner)] |= isShared[t];
    }
  }
  complete(
    leaves, hasShared, [&](std::size_t k) { return mesh.points[k]; }, places.points);
  complete(
    leaves, isShared,
    [&](std::size_t t)
    {
      const Triangle& corner = mesh.triangles[t];
      return Vec3((mesh.points[std::size_t(corner[0])] + mesh.points[std::size_t(corner[1])] +
                    mesh.points[std::size_t(corner[2])]) /
        3.0);
    },
    places.triangles);
  return places;
}

} // namespace hybridtree
