// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Regions.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <queue>
#include <vector>

namespace hybridtree
{

/// The moving surface of convection: the boundary of the tetrahedra it has not passed, largest
/// facet first. It passes
/// - tetrahedra of the outside through any half-facet that is not oriented Gabriel, or through any
///   at all if pockets are to be opened;
/// - tetrahedra of the surface layer through half-facets that are not oriented Gabriel, where that
///   leaves the topology alone: so it settles into the dents of the sampling but does not tear
///   thin walls;
/// - tetrahedra of the inside never: it cannot leak through places of thin sampling.
class Front
{
public:
  Front(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
    const std::vector<Region>& regions);

  /// Shrinks the front from the convex hull. Once.
  void run(bool openPockets, const Progress& progress);

  /// Per cell: 1 if not passed; infinite cells 0.
  const std::vector<std::uint8_t>& inside() const { return inside_; }

private:
  struct HalfFacet
  {
    double size;
    std::int32_t cell;
    std::int32_t facet;
    bool operator<(const HalfFacet& other) const;
  };

  bool isInside(std::int32_t cell) const { return inside_[cell] != 0; }
  bool onSurface(std::int32_t cell, int facet) const
  {
    return this->isInside(cell) && !this->isInside(tetrahedra_.neighbor(cell, facet));
  }
  void uncover(std::int32_t cell, int facet);
  void cancel(std::int32_t cell, int facet);
  bool mayPass(const HalfFacet& at, bool openPockets);
  void pass(std::int32_t cell);
  bool keepsTopology(std::int32_t cell, std::int32_t& blocker) const;
  bool edgeIsBuried(std::int32_t cell, int i, int j) const;

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const std::vector<Region>& regions_;
  std::vector<std::uint8_t> inside_;         // per cell
  std::vector<std::int32_t> surfaceFacets_;  // per point: facets of the surface around it
  std::vector<std::vector<HalfFacet>> held_; // per point: facets that wait for it to be freed
  std::priority_queue<HalfFacet> queue_;
};

} // namespace hybridtree
