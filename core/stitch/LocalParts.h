// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/stitch/Island.h"

#include <vector>

namespace hybridtree
{

/// What an island needs of the meshes that it is cut into: the triangles near its cells, and those
/// around them. Where an edit has made a mesh anew that is the same there, to the last bit, the
/// island is the same but for the numbers of triangles and points.
class LocalParts
{
public:
  /// \param cells of the island.
  LocalParts(const std::vector<KeptPart>& parts, const CellSet& cells, const CellGrid& grid);

  /// Whether an island depends on nothing else in the parts: cut triangles so large that those
  /// beyond them are triangulated anew with them (CutZone.h) may take in others, far away.
  bool areAllOf(const IslandCut& cut, const CellGrid& grid) const;

  /// All that there is of them here, but for leaves: their meshes stay the same objects when others
  /// are made anew, and may be large, so those who compare contents compare these objects, too.
  void describe(Contents& contents) const;

  /// Numbers in the parts replaced by places among what is here. \pre the island was made here.
  Island toPlaces(const Island& island) const;
  /// And back, for equal contents.
  Island fromPlaces(const Island& island) const;

private:
  struct Part
  {
    KeptPart part;
    std::vector<std::int32_t> triangles; ///< rising, as the points; none of a leaf, all stay
    std::vector<std::int32_t> points;
  };

  std::vector<Part> parts_;
};

} // namespace hybridtree
