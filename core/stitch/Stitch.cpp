// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Stitch.h"

#include "core/polygonize/MemoryBudget.h"
#include "core/stitch/Assemble.h"
#include "core/stitch/CheckPatch.h"
#include "core/stitch/PatchShape.h"
#include "core/stitch/ProjectPoints.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kReach = 0.5; // cells that a cut vertex may move

/// Where the gradient gives no normal, the triangles do.
void mendNormals(TriangleMesh& mesh, std::size_t firstTriangle)
{
  std::vector<std::int32_t> missing;
  std::vector<Vec3> sums;
  for (std::size_t t = firstTriangle; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t v : mesh.triangles[t])
    {
      if (mesh.normals[v].isZero(0.0))
      {
        missing.push_back(v);
        sums.push_back(areaNormal(mesh, t));
      }
    }
  }
  for (std::size_t k = 0; k < missing.size(); ++k)
  {
    mesh.normals[missing[k]] += sums[k];
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  for (const std::int32_t v : missing)
  {
    mesh.normals[v].stableNormalize();
  }
}

/// New points that are not yet on the surface: the unsettled ones of the patch, and cut vertices of
/// parts whose triangles are chords of it. On mesh leaves those are where they belong.
std::vector<std::size_t> pointsToMove(const std::vector<KeptPart>& parts,
  const std::vector<CutMesh>& cuts, const Patch& patch, const StitchedMesh& stitched)
{
  std::vector<std::size_t> points;
  std::size_t next = stitched.keptPoints;
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    for (std::size_t k = 0; k < cuts[p].vertices.size(); ++k, ++next)
    {
      if (!parts[p].isLeaf)
      {
        points.push_back(next);
      }
    }
  }
  for (const std::int32_t v : patch.unsettled)
  {
    points.push_back(stitched.keptPoints + static_cast<std::size_t>(v));
  }
  return points;
}

/// Cells in which something is wrong with the new triangles.
std::vector<Index3> faults(const StitchedMesh& stitched, const CellGrid& grid)
{
  const TriangleMesh& mesh = stitched.mesh;
  std::vector<Index3> cells;
  for (const std::int32_t v : faultyPoints(mesh, stitched.keptTriangles))
  {
    cells.push_back(grid.cellAt(mesh.points[v]));
  }
  for (const std::size_t t : turnedTriangles(mesh, stitched.keptTriangles))
  {
    const Triangle& c = mesh.triangles[t];
    cells.push_back(grid.cellAt((mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0));
  }
  return cells;
}

/// Marks cells and what is around them, the further the later in the rounds.
void markAround(const std::vector<Index3>& faults, int reach, CellSet& cells)
{
  CellSet more;
  for (const Index3& cell : faults)
  {
    more.insert(cell);
  }
  for (int ring = 0; ring < reach; ++ring)
  {
    more = more.grown();
  }
  cells.insert(more);
}

} // namespace

std::optional<StitchedMesh> stitch(const FieldSource& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress)
{
  const MemoryBudget budget{ options.maxBytes, options.grid.cellSize };
  for (int round = 1; round <= options.maxRounds; ++round)
  {
    const ProgressPart part(progress, double(round - 1) / round, 1.0);
    cells.fillDiagonals();
    std::vector<CutMesh> cuts;
    for (const KeptPart& kept : parts)
    {
      cuts.push_back(cutMesh(*kept.mesh, cells, options.grid, progress));
    }
    const JointBorder joint = jointBorder(parts, cuts);
    const Patch patch =
      makePatch(field, cells, options.grid, joint.border, budget, ProgressPart(part, 0.1, 0.8));
    StitchedMesh stitched = assemble(parts, cuts, patch);
    stitched.rounds = round;
    projectPoints(field, pointsToMove(parts, cuts, patch, stitched), kReach * options.grid.cellSize,
      stitched.mesh);
    mendNormals(stitched.mesh, stitched.keptTriangles);
    improveShapes(field, stitched, options.grid.cellSize);
    std::vector<Index3> wrong = faults(stitched, options.grid);
    wrong.insert(wrong.end(), patch.misfits.begin(), patch.misfits.end());
    if (wrong.empty())
    {
      return stitched;
    }
    markAround(wrong, round, cells);
  }
  return std::nullopt;
}

} // namespace hybridtree
