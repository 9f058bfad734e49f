// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceMeshes.h"

#include "core/base/LargestFirst.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kAxisReach = 2.7; // of a piece's mesh from its skeleton, in radii

/// Around the children of a coarse element: all that its part of a mesh may ask of the field.
template <std::size_t N>
Box3 surroundings(const RefinedSkeleton& refined,
  const std::vector<std::array<std::int32_t, N>>& elements, std::int32_t coarse, int parts)
{
  Box3 box;
  double radius = 0.0;
  for (std::int32_t n = coarse * parts; n < (coarse + 1) * parts; ++n)
  {
    for (const std::int32_t point : elements[n])
    {
      box.extend(refined.points[point]);
      radius = std::max(radius, refined.radii[point]);
    }
  }
  box.min().array() -= kAxisReach * radius;
  box.max().array() += kAxisReach * radius;
  return box;
}

/// Keys for the pieces of one skeleton.
class PieceKeys
{
public:
  PieceKeys(const SkeletonField& skeleton, const PieceMeshOptions& options)
    : skeleton_(skeleton), options_(options)
  {
  }

  PieceKey ofCurve(const CurvePiece& piece) const
  {
    PieceKey key = this->of(piece.segments, skeleton_.refined.segments, 1 << skeleton_.level, 0);
    key.own.add(std::int32_t(piece.closed));
    return key;
  }

  PieceKey ofSurface(const SurfacePiece& piece) const
  {
    PieceKey key = this->of(piece.triangles, skeleton_.refined.triangles,
      1 << (2 * skeleton_.level), std::int32_t(skeleton_.coarse.segments.size()));
    key.own.add(std::int32_t(-1));
    return key;
  }

private:
  template <std::size_t N>
  PieceKey of(const std::vector<std::int32_t>& own,
    const std::vector<std::array<std::int32_t, N>>& elements, int parts, std::int32_t first) const
  {
    PieceKey key;
    key.own.add(std::int32_t(skeleton_.elements ? 1 + int(skeleton_.elements->areOwnSums()) : 0));
    key.own.add(options_.refinement);
    key.own.add(options_.longestEdge);
    key.own.add(std::int32_t(options_.findSources));
    std::vector<Box3> boxes;
    std::vector<std::int32_t> places;
    for (const std::int32_t coarse : own)
    {
      key.own.add(coarse);
      places.push_back(first + coarse);
      boxes.push_back(surroundings(skeleton_.refined, elements, coarse, parts));
    }
    const bool areOwnSums =
      skeleton_.elements && skeleton_.elements->areOwnSums() && !options_.findSources;
    key.field.push_back(
      areOwnSums ? skeleton_.local->ownSums(places, boxes) : skeleton_.local->around(boxes));
    return key;
  }

  const SkeletonField& skeleton_;
  const PieceMeshOptions& options_;
};

std::size_t bytesOf(const PieceMesh& mesh, const PieceKey& key)
{
  return mesh.points.size() * (3 * sizeof(Vec3) + 5) + mesh.triangles.size() * sizeof(Triangle) +
    mesh.triangles.size() * sizeof(std::int32_t) + sizeof(PieceMesh) + key.own.bytes();
}

} // namespace

std::uint64_t PieceKey::hash() const
{
  HashSum sum;
  sum.add(own.hash());
  for (const Dependency& dependency : field)
  {
    dependency.addTo(sum);
  }
  return sum.value();
}

std::vector<PieceMeshPtr> pieceMeshes(const SkeletonField& skeleton,
  const PieceMeshOptions& options, PieceMeshCache* cache, const Progress& progress)
{
  const SkeletonPieces pieces = findPieces(skeleton.coarse, SkeletonTopology(skeleton.coarse));
  const std::size_t curves = pieces.curves.size();
  const PieceKeys keys(skeleton, options);
  const PlacedField field{ skeleton.field, skeleton.elements, progress };
  const bool isKept = cache && skeleton.local;
  std::vector<PieceMeshPtr> result(pieces.size());
  std::vector<std::size_t> sizes; // elements, a triangle for about two segments
  for (const CurvePiece& curve : pieces.curves)
  {
    sizes.push_back(curve.segments.size() << skeleton.level);
  }
  for (const SurfacePiece& surface : pieces.surfaces)
  {
    sizes.push_back(surface.triangles.size() << (2 * skeleton.level + 1));
  }
  forLargestFirst(sizes,
    [&](std::size_t k)
    {
      progress.check();
      const bool isCurve = k < curves;
      PieceKey key;
      if (isKept)
      {
        key =
          isCurve ? keys.ofCurve(pieces.curves[k]) : keys.ofSurface(pieces.surfaces[k - curves]);
        result[k] = cache->find(key);
      }
      if (result[k])
      {
        return;
      }
      const PieceCage cage = isCurve
        ? curveCage(pieces.curves[k], skeleton.refined, skeleton.level, field)
        : surfaceCage(pieces.surfaces[k - curves], skeleton.refined, skeleton.level, field);
      auto mesh = std::make_shared<PieceMesh>(refineCage(cage, field, options, progress));
      result[k] = mesh;
      if (isKept)
      {
        const std::size_t bytes = bytesOf(*mesh, key);
        cache->keep(std::move(key), mesh, bytes);
      }
    });
  return result;
}

TriangleMesh joinPieces(const std::vector<PieceMeshPtr>& pieces)
{
  TriangleMesh mesh;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const auto first = std::int32_t(mesh.points.size());
    const PieceMesh& piece = *pieces[k];
    mesh.points.insert(mesh.points.end(), piece.points.begin(), piece.points.end());
    mesh.normals.insert(mesh.normals.end(), piece.normals.begin(), piece.normals.end());
    for (const auto& [a, b, c] : piece.triangles)
    {
      mesh.triangles.push_back({ first + a, first + b, first + c });
    }
    mesh.sourceLeaf.resize(mesh.triangles.size(), std::int32_t(k));
  }
  return mesh;
}

} // namespace hybridtree
