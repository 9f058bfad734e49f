// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendChoice.h"

#include "core/stitch/KeptMesh.h"

#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

/// Length of the sharp edges of meshes that are leaves, in cells.
double creasesOf(const std::vector<KeptPart>& kept, double cellSize)
{
  double length = 0.0;
  for (const KeptPart& part : kept)
  {
    length += part.isLeaf ? KeptMesh::of(part.mesh)->creaseLength() : 0.0;
  }
  return length / cellSize;
}

double trianglesOf(const std::vector<KeptPart>& kept)
{
  std::size_t count = 0;
  for (const KeptPart& part : kept)
  {
    count += part.mesh->triangles.size();
  }
  return static_cast<double>(count);
}

template <typename Cost, typename Surface>
std::optional<CellSet> ifCheaper(
  const Cost& cost, std::optional<CellSet> cells, const Surface& surface)
{
  return cells && cost.isLocalCheaper(*cells, surface) ? std::move(cells) : std::nullopt;
}

} // namespace

double squaresOf(const std::vector<KeptPart>& kept, double cellSize)
{
  double area = 0.0;
  for (const KeptPart& part : kept)
  {
    area += KeptMesh::of(part.mesh)->area();
  }
  return area / (cellSize * cellSize);
}

BlendChoice::BlendChoice(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const MemoryBudget& budget, const Progress& progress)
  : terms_(terms), grid_(grid), marker_(terms, interaction, grid, budget, progress)
{
}

CellSet BlendChoice::markAll()
{
  return *marker_.mark(std::numeric_limits<std::size_t>::max());
}

std::optional<CellSet> BlendChoice::byTerms(const BlendCost& cost)
{
  const BlendCost::Surface surface{ squaresByPoints(terms_, grid_.cellSize),
    squaresGivenUp(terms_, grid_.cellSize) };
  return ifCheaper(cost, this->markIfFew(cost.mostCells(surface)), surface);
}

std::optional<CellSet> BlendChoice::bySample(
  const DeformedBlendCost& cost, const BlendSample& sample)
{
  const BlendCost::Surface surface{ sample.squares(), 0.0 };
  std::optional<CellSet> cells = this->markIfFew(cost.mostCells(surface));
  return cells && cost.isLocalCheaper(*cells, surface, sample.division(*cells, grid_))
    ? std::move(cells)
    : std::nullopt;
}

std::optional<CellSet> BlendChoice::byMeshes(
  const BlendCost& cost, const std::vector<KeptPart>& kept)
{
  const BlendCost::Surface surface = this->surfaceOf(kept);
  return ifCheaper(cost, this->markIfFew(cost.mostCells(surface)), surface);
}

std::optional<CellSet> BlendChoice::byMeshes(
  const DeformedBlendCost& cost, const std::vector<KeptPart>& kept)
{
  const DeformedBlendCost::Surface surface{ this->surfaceOf(kept), trianglesOf(kept) };
  return ifCheaper(cost, this->markIfFew(cost.mostCells(surface)), surface);
}

BlendCost::Surface BlendChoice::surfaceOf(const std::vector<KeptPart>& kept) const
{
  return { squaresOf(kept, grid_.cellSize), squaresGivenUp(terms_, grid_.cellSize),
    creasesOf(kept, grid_.cellSize) };
}

// Some more: the choice is by their border, then.
std::optional<CellSet> BlendChoice::markIfFew(std::size_t most)
{
  return marker_.seemMoreThan(most) ? std::nullopt : marker_.mark(most + most / 4);
}

} // namespace hybridtree
