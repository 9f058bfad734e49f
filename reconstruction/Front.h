// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Regions.h"
#include "reconstruction/SizeQueue.h"
#include "reconstruction/SolidRepair.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <queue>
#include <vector>

namespace hybridtree
{

/// The moving surface of convection: the boundary of the tetrahedra it has not passed, largest
/// facet first. It passes
/// - tetrahedra of the outside through any half-facet if pockets are to be opened, else through
///   those that are not oriented Gabriel;
/// - tetrahedra of the surface layer through half-facets that are not oriented Gabriel: so it
///   settles into the dents of the sampling;
/// - tetrahedra of the inside never: it cannot leak through places of thin sampling.
///
/// Empty space beside which the sampling is small is passed at once, if pockets are to be opened:
/// there the order of steps would not matter.
///
/// All of this only where it leaves the topology alone, so no unevenness of the sampling makes a
/// handle. Where the surface has come around an object from both sides, it stands back to back with
/// itself: a membrane that no such step removes. When nothing else is left to do, the widest
/// membrane is torn, if it is wider than the sampling, and the surface goes on from there. So each
/// handle and each gap between objects is one decision, made at its narrowest place.
class Front
{
public:
  Front(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
    const std::vector<Region>& regions);

  /// Shrinks the front from the convex hull, or that part of it before infinite cells that are not
  /// Inside. Then, if voids are kept, from within spaces of the outside that it has not reached.
  /// Once. \throws Cancelled.
  void run(bool openPockets, Voids voids, const Progress& progress);

  /// Per cell: 1 if not passed; infinite cells 0 unless Inside.
  const std::vector<std::uint8_t>& inside() const { return inside_; }

private:
  // Half-facets are 4 * cell + facet.
  struct Membrane
  {
    double size;
    std::int32_t halfFacet;
    bool operator<(const Membrane& other) const
    {
      return size != other.size ? size < other.size : halfFacet < other.halfFacet;
    }
  };

  bool isInside(std::int32_t cell) const { return inside_[cell] != 0; }
  bool onSurface(std::int32_t cell, int facet) const
  {
    return this->isInside(cell) && !this->isInside(tetrahedra_.neighbor(cell, facet));
  }
  void passEmptySpace(const Progress& progress);
  std::int32_t nextToPass();
  void readAhead() const;
  void flow(const Progress& progress);
  void openVoids(const Progress& progress);
  bool isBuried(std::int32_t cell) const;
  void reach(std::int32_t cell);
  void uncover(std::int32_t cell, int facet);
  bool mayEverPass(std::int32_t cell, int facet) const;
  bool mayPass(std::int32_t halfFacet);
  void tear(std::int32_t cell);
  void pass(std::int32_t cell);
  bool keepsTopology(std::int32_t cell) const;
  bool edgeIsBuried(std::int32_t cell, int i, int j) const;
  void markEdges(std::int32_t cell, unsigned open);
  static std::uint64_t bitOfEnd(std::int32_t vertex);

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const std::vector<Region>& regions_;
  bool openPockets_ = true;
  std::size_t passed_ = 0;
  std::vector<std::uint8_t> inside_;  // per cell
  std::vector<std::uint8_t> held_;    // per cell: facets through which it may not be passed yet
  std::vector<std::uint8_t> reached_; // per point: whether a cell around it is passed
  // Per point: bits of the other ends of edges to higher points around which a cell is passed.
  // Edges may share a bit.
  std::vector<std::uint64_t> edges_;
  SizeQueue queue_;
  std::priority_queue<Membrane> membranes_;
};

} // namespace hybridtree
