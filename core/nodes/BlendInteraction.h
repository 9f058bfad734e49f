// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/MarkedCells.h"

#include <vector>

namespace hybridtree
{

/// Of a sum of fields: two that meet, or one without a mesh. What only carves has no surface.
class SumInteraction final : public Interaction
{
public:
  int kind() const override { return 0; }
  bool marks(const std::vector<MarkTerm>& terms, const std::vector<int>& present) const override;
  Interval range(const std::vector<int>&, const std::vector<Interval>& ranges) const override;
};

/// Of a local blend over A, B, region and their union: only where all three are there it is not the
/// union.
class LocalInteraction final : public Interaction
{
public:
  int kind() const override { return 1; }
  bool marks(const std::vector<MarkTerm>& terms, const std::vector<int>& present) const override;
  Interval range(
    const std::vector<int>& present, const std::vector<Interval>& ranges) const override;
};

} // namespace hybridtree
