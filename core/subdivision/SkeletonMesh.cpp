// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonMesh.h"

#include "core/mesh/Dust.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace hybridtree
{
namespace
{

constexpr double kLongest = 4.0 / 3.0; // edge, in cells
constexpr double kDust = 0.02;         // volume per area of a part that is none, in cells
constexpr double kMargin = 0.25;       // around triangles, in cells: more than pieces differ by

/// Which part of which piece is in a cell.
struct Owner
{
  std::size_t piece;
  Vec3 base;
};

class Marker
{
public:
  explicit Marker(const CellGrid& grid) : grid_(grid) {}

  /// Of bodies that no piece has, because the sheet in them is hardly inside: one cell of the
  /// surface, found from a point inside.
  void addSeeds(const std::vector<Vec3>& inside, const FieldSource& field)
  {
    constexpr int kMaxSteps = 1000;
    std::unordered_set<Index3, Index3Hash> tried;
    for (const Vec3& point : inside)
    {
      Index3 cell = grid_.cellAt(point);
      for (int step = 0; step < kMaxSteps && tried.insert(cell).second; ++step, ++cell[0])
      {
        if (owners_.count(cell) != 0 || cells_.contains(cell))
        {
          break;
        }
        sampleCorners({ cell }, field);
        if (isCrossed(cell))
        {
          cells_.insert(cell);
          break;
        }
      }
    }
  }

  CellSet take(const FieldSource& field)
  {
    addUncovered(field);
    cells_.fillDiagonals();
    cells_.sort();
    return std::move(cells_);
  }

  void addPiece(
    std::size_t number, const PieceMesh& piece, const FieldSource& field, double tolerance)
  {
    std::vector<Vec3> centers;
    for (const auto& [a, b, c] : piece.triangles)
    {
      centers.push_back((piece.points[a] + piece.points[b] + piece.points[c]) / 3.0);
    }
    const std::vector<double> values = fieldAt(field, centers);
    for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    {
      const auto& [a, b, c] = piece.triangles[t];
      const bool settled = piece.onSurface[a] && piece.onSurface[b] && piece.onSurface[c] &&
        std::abs(values[t] - kThreshold) <= tolerance;
      Box3 box(piece.points[a]);
      box.extend(piece.points[b]);
      box.extend(piece.points[c]);
      const Vec3 base = (piece.bases[a] + piece.bases[b] + piece.bases[c]) / 3.0;
      // Neighbours around a limb share their base; beyond its thickness begins another part.
      const double apart = 2.0 * (centers[t] - base).norm() + 2.0 * grid_.cellSize;
      visitCells(box,
        [&](const Index3& cell)
        {
          const auto [found, isNew] = owners_.try_emplace(cell, Owner{ number, base });
          const bool alone =
            isNew || (found->second.piece == number && (found->second.base - base).norm() < apart);
          if (!settled || !alone)
          {
            cells_.insert(cell);
          }
        });
    }
  }

private:
  /// From marked cells on, those that the surface crosses and no piece is in: where all pieces end
  /// inside of others and none has what lies between them.
  void addUncovered(const FieldSource& field)
  {
    std::vector<Index3> front;
    cells_.forEach([&](const Index3& cell) { front.push_back(cell); });
    std::unordered_set<Index3, Index3Hash> seen;
    while (!front.empty())
    {
      std::vector<Index3> next;
      for (const Index3& cell : front)
      {
        for (int side = 0; side < 6; ++side)
        {
          Index3 beside = cell;
          beside[side / 2] += side % 2 ? 1 : -1;
          if (owners_.count(beside) == 0 && !cells_.contains(beside) && seen.insert(beside).second)
          {
            next.push_back(beside);
          }
        }
      }
      sampleCorners(next, field);
      front.clear();
      for (const Index3& cell : next)
      {
        if (isCrossed(cell))
        {
          cells_.insert(cell);
          front.push_back(cell);
        }
      }
    }
  }

  static Index3 corner(const Index3& cell, int k)
  {
    return { cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2) };
  }

  void sampleCorners(const std::vector<Index3>& cells, const FieldSource& field)
  {
    std::vector<Index3> asked;
    std::vector<Vec3> points;
    for (const Index3& cell : cells)
    {
      for (int k = 0; k < 8; ++k)
      {
        const Index3 at = corner(cell, k);
        if (inside_.try_emplace(at, false).second)
        {
          asked.push_back(at);
          points.emplace_back(grid_.plane(0, at[0]), grid_.plane(1, at[1]), grid_.plane(2, at[2]));
        }
      }
    }
    const std::vector<double> values = fieldAt(field, points);
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      inside_[asked[k]] = values[k] >= kThreshold;
    }
  }

  bool isCrossed(const Index3& cell) const
  {
    int count = 0;
    for (int k = 0; k < 8; ++k)
    {
      count += inside_.at(corner(cell, k)) ? 1 : 0;
    }
    return count != 0 && count != 8;
  }

  template <typename Visit>
  void visitCells(Box3 box, Visit&& visit) const
  {
    box.min().array() -= kMargin * grid_.cellSize;
    box.max().array() += kMargin * grid_.cellSize;
    const Index3 low = grid_.cellAt(box.min());
    const Index3 high = grid_.cellAt(box.max());
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
        {
          visit(Index3{ x, y, z });
        }
      }
    }
  }

  const CellGrid& grid_;
  CellSet cells_;
  std::unordered_map<Index3, Owner, Index3Hash> owners_;
  std::unordered_map<Index3, bool, Index3Hash> inside_; // sides of corners
};

/// Centers of the skeleton's triangles that are inside.
std::vector<Vec3> insideOfSheets(const SkeletonField& skeleton)
{
  std::vector<Vec3> centers;
  for (const auto& [a, b, c] : skeleton.refined.triangles)
  {
    const std::vector<Vec3>& points = skeleton.refined.points;
    centers.push_back((points[a] + points[b] + points[c]) / 3.0);
  }
  const std::vector<double> values = fieldAt(skeleton.field, centers);
  std::vector<Vec3> inside;
  for (std::size_t k = 0; k < centers.size(); ++k)
  {
    if (values[k] > kThreshold)
    {
      inside.push_back(centers[k]);
    }
  }
  return inside;
}

MeshPtr withoutExtras(const PieceMesh& piece)
{
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->points = piece.points;
  mesh->normals = piece.normals;
  mesh->triangles = piece.triangles;
  return mesh;
}

} // namespace

CellSet cellsWherePiecesMeet(const std::vector<PieceMeshPtr>& pieces, const SkeletonField& skeleton,
  double refinement, const CellGrid& grid)
{
  const FieldSource& field = skeleton.field;
  Marker marker(grid);
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    marker.addPiece(k, *pieces[k], field, 2.0 * refinement * kThreshold);
  }
  marker.addSeeds(insideOfSheets(skeleton), field);
  return marker.take(field);
}

std::optional<StitchedMesh> skeletonMesh(const SkeletonField& skeleton,
  const SkeletonMeshOptions& options, PieceMeshCache* cache, const Progress& progress)
{
  const std::vector<double>& radii = skeleton.refined.radii;
  if (*std::max_element(radii.begin(), radii.end()) < kDust * options.edgeLength)
  {
    return StitchedMesh(); // all of it would be dust
  }
  PieceMeshOptions pieceOptions;
  pieceOptions.refinement = options.refinement;
  pieceOptions.longestEdge = kLongest * options.edgeLength;
  const std::vector<PieceMeshPtr> pieces =
    pieceMeshes(skeleton, pieceOptions, cache, ProgressPart(progress, 0.0, 0.4));
  StitchOptions stitching;
  stitching.grid = CellGrid::ofLevel(options.edgeLength, 1);
  stitching.maxBytes = options.maxBytes;
  stitching.haveCreases = !skeleton.isSmooth;
  CellSet cells = cellsWherePiecesMeet(pieces, skeleton, options.refinement, stitching.grid);
  std::vector<KeptPart> parts;
  for (const PieceMeshPtr& piece : pieces)
  {
    if (!piece->triangles.empty())
    {
      KeptPart part;
      part.mesh = withoutExtras(*piece);
      parts.push_back(std::move(part));
    }
  }
  std::optional<StitchedMesh> result =
    stitch(skeleton.field, parts, std::move(cells), stitching, ProgressPart(progress, 0.4, 1.0));
  if (result)
  {
    dropDust(result->mesh, kDust * options.edgeLength);
  }
  return result;
}

} // namespace hybridtree
