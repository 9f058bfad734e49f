// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Island.h"
#include "core/stitch/Stitch.h"

#include <memory>
#include <vector>

namespace hybridtree
{

/// An island over some of the parts: its part k is part parts[k] of all.
struct PlacedIsland
{
  std::shared_ptr<const Island> island;
  std::vector<std::int32_t> parts;
};

/// One mesh of what is kept of the parts and the islands, in their order. A few copies of the
/// parts' arrays, in parallel; nothing is looked for.
StitchedMesh assemble(const std::vector<KeptPart>& parts, const std::vector<PlacedIsland>& islands);

} // namespace hybridtree
