// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonMesh.h"

#include "core/base/LargestFirst.h"
#include "core/mesh/Dust.h"
#include "core/subdivision/PieceCells.h"
#include "core/subdivision/PieceSources.h"
#include "core/subdivision/UncoveredCells.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kLongest = 4.0 / 3.0; // edge, in cells
constexpr double kDust = 0.02;         // volume per area of a part that is none, in cells

/// Cells of several sets: all, and those in more than one.
struct SharedCells
{
  CellSet all;
  CellSet shared;

  void add(const CellSet& cells)
  {
    for (const CellSet::Brick& brick : cells.bricks())
    {
      if (const BrickBits* before = all.find(brick.index))
      {
        CellSet::Brick both = brick;
        for (std::size_t z = 0; z < kBrickSide; ++z)
        {
          both.bits[z] &= (*before)[z];
        }
        if (both.size() > 0)
        {
          shared.insertBrick(both);
        }
      }
      all.insertBrick(brick);
    }
  }
};

/// Of bodies that no piece has, because the sheet in them is hardly inside: one cell of the
/// surface, found from a point inside. Several cells of each way are looked at together.
void addSeeds(const std::vector<Vec3>& inside, const CellSet& covered, const FieldSource& field,
  const CellGrid& grid, CellSet& marked)
{
  constexpr int kRounds = 64;
  constexpr int kSteps = 16;
  CellSet tried;
  std::vector<Index3> places;
  for (const Vec3& point : inside)
  {
    places.push_back(grid.cellAt(point));
  }
  for (int round = 0; round < kRounds && !places.empty(); ++round)
  {
    std::vector<std::vector<Index3>> ways;
    CellSet asked;
    for (Index3 cell : places)
    {
      std::vector<Index3> way;
      for (; way.size() < kSteps && !tried.contains(cell) && !covered.contains(cell) &&
           !marked.contains(cell);
           ++cell[0])
      {
        way.push_back(cell);
        tried.insert(cell);
        asked.insert(cell);
      }
      ways.push_back(std::move(way));
    }
    const CellSet crossed = crossedCells(asked, field, grid);
    places.clear();
    for (const std::vector<Index3>& way : ways)
    {
      const auto found = std::find_if(
        way.begin(), way.end(), [&](const Index3& cell) { return crossed.contains(cell); });
      if (found != way.end())
      {
        marked.insert(*found);
      }
      else if (way.size() == kSteps)
      {
        const Index3& last = way.back();
        places.push_back({ last[0] + 1, last[1], last[2] });
      }
    }
  }
}

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

} // namespace

CellSet cellsWherePiecesMeet(const std::vector<PieceMeshPtr>& pieces, const SkeletonField& skeleton,
  double refinement, const CellGrid& grid)
{
  const FieldSource& field = skeleton.field;
  const bool isWhole = skeleton.elements && !skeleton.elements->areOwnSums();
  const PlacedField placed(field, isWhole ? skeleton.elements : nullptr);
  std::vector<std::shared_ptr<const PieceCells>> found(pieces.size());
  std::vector<std::size_t> sizes;
  for (const PieceMeshPtr& piece : pieces)
  {
    sizes.push_back(piece->triangles.size());
  }
  forLargestFirst(sizes,
    [&](std::size_t k)
    { found[k] = pieceCells(pieces[k], placed, 2.0 * refinement * kThreshold, grid); });
  SharedCells cells;
  CellSet marked;
  for (const std::shared_ptr<const PieceCells>& of : found)
  {
    cells.add(of->all);
    marked.insert(of->unsettled);
  }
  marked.insert(cells.shared);
  addSeeds(insideOfSheets(skeleton), cells.all, field, grid, marked);
  addUncovered(cells.all, field, grid, marked);
  marked.fillDiagonals();
  marked.sort();
  return marked;
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
  pieceOptions.findSources = skeleton.local != nullptr;
  const std::vector<PieceMeshPtr> pieces =
    pieceMeshes(skeleton, pieceOptions, cache, ProgressPart(progress, 0.0, 0.4));
  StitchOptions stitching;
  stitching.grid = CellGrid::ofLevel(options.edgeLength, 1);
  stitching.maxBytes = options.maxBytes;
  stitching.haveCreases = !skeleton.isSmooth;
  stitching.unfold = true;
  CellSet cells = cellsWherePiecesMeet(pieces, skeleton, options.refinement, stitching.grid);
  std::vector<KeptPart> parts;
  std::vector<PieceMeshPtr> partPieces;
  for (const PieceMeshPtr& piece : pieces)
  {
    if (!piece->triangles.empty())
    {
      KeptPart part;
      part.mesh = piece;
      parts.push_back(std::move(part));
      partPieces.push_back(piece);
    }
  }
  const ProgressPart rest(progress, 0.4, 1.0);
  std::optional<StitchedMesh> result = skeleton.local
    ? stitch(*skeleton.local, parts, std::move(cells), stitching, rest)
    : stitch(skeleton.field, parts, std::move(cells), stitching, rest);
  if (result)
  {
    if (skeleton.local)
    {
      findPieceSources(*skeleton.local, partPieces, *result, rest);
    }
    dropDust(result->mesh, kDust * options.edgeLength);
  }
  return result;
}

} // namespace hybridtree
