// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BlendCost.h"
#include "core/nodes/BlendEstimate.h"
#include "core/nodes/MarkedCells.h"
#include "core/stitch/Stitch.h"

#include <optional>
#include <vector>

namespace hybridtree
{

/// The cells of a blend that are made anew, where that costs less than the whole lattice. The same
/// for the same questions in the same order, whatever is remembered.
class BlendChoice
{
public:
  /// All must outlive this.
  BlendChoice(const std::vector<MarkTerm>& terms, const Interaction& interaction,
    const CellGrid& grid, const MemoryBudget& budget, const Progress& progress);

  /// All of them.
  CellSet markAll();

  ///@{
  /// \return nothing where the whole lattice is cheaper. By what the terms tell, before anything is
  /// meshed, by points near their surfaces, or by the meshes that are kept.
  std::optional<CellSet> byTerms(const BlendCost& cost);
  std::optional<CellSet> bySample(const DeformedBlendCost& cost, const BlendSample& sample);
  std::optional<CellSet> byMeshes(const BlendCost& cost, const std::vector<KeptPart>& kept);
  std::optional<CellSet> byMeshes(const DeformedBlendCost& cost, const std::vector<KeptPart>& kept);
  ///@}

private:
  BlendCost::Surface surfaceOf(const std::vector<KeptPart>& kept) const;
  std::optional<CellSet> markIfFew(std::size_t most);

  const std::vector<MarkTerm>& terms_;
  const CellGrid& grid_;
  CellMarker marker_;
};

/// Area of meshes, in squared cells.
double squaresOf(const std::vector<KeptPart>& kept, double cellSize);

} // namespace hybridtree
