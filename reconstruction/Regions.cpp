// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Regions.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace hybridtree
{
namespace
{

// A region whose longest edge is less than this many times as long as that of the way into it is no
// region of its own. Plain lengths: sizes relative to the sampling jump from point to point.
constexpr double kDepth = 1.25;

struct Passage
{
  double size;
  std::int32_t cell;
  std::int32_t facet;
  bool operator<(const Passage& other) const
  {
    return std::tie(other.size, cell, facet) < std::tie(size, other.cell, other.facet);
  }
};

std::vector<Passage> widePassages(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, double wide)
{
  std::vector<Passage> passages;
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      if (tetrahedra.neighbor(cell, facet) > cell)
      {
        const double size = sizes.ofFacet(cell, facet);
        if (size > wide)
        {
          passages.push_back({ size, cell, facet });
        }
      }
    }
  }
  std::sort(passages.begin(), passages.end());
  return passages;
}

// Disjoint sets of cells that know the longest edge of theirs.
class Basins
{
public:
  Basins(const Tetrahedralization& tetrahedra, const FacetSize& sizes)
    : parent_(tetrahedra.cellCount())
    , depth_(tetrahedra.cellCount(), std::numeric_limits<double>::infinity())
  {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
    {
      depth_[cell] = sizes.lengthOfCell(cell);
    }
    // The outside is one.
    for (std::int32_t cell = tetrahedra.finiteCellCount(); cell < tetrahedra.cellCount(); ++cell)
    {
      parent_[cell] = tetrahedra.finiteCellCount();
    }
  }

  std::int32_t find(std::int32_t cell)
  {
    while (parent_[cell] != cell)
    {
      cell = parent_[cell] = parent_[parent_[cell]];
    }
    return cell;
  }
  double depth(std::int32_t basin) const { return depth_[basin]; }
  void join(std::int32_t a, std::int32_t b)
  {
    if (depth_[a] < depth_[b])
    {
      std::swap(a, b);
    }
    parent_[b] = a;
  }

private:
  std::vector<std::int32_t> parent_;
  std::vector<double> depth_;
};

} // namespace

std::vector<Region> findRegions(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, double wide, double mouth)
{
  Basins basins(tetrahedra, sizes);
  for (const Passage& passage : widePassages(tetrahedra, sizes, wide))
  {
    const std::int32_t here = basins.find(passage.cell);
    const std::int32_t there = basins.find(tetrahedra.neighbor(passage.cell, passage.facet));
    const double shallow = std::min(basins.depth(here), basins.depth(there));
    if (here != there &&
      (passage.size > mouth || shallow < kDepth * sizes.lengthOfFacet(passage.cell, passage.facet)))
    {
      basins.join(here, there);
    }
  }
  std::vector<Region> regions(tetrahedra.cellCount(), Region::Outside);
  const std::int32_t outside = basins.find(tetrahedra.finiteCellCount());
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    if (sizes.ofCell(cell) <= wide)
    {
      regions[cell] = Region::Surface;
    }
    else if (basins.find(cell) != outside)
    {
      regions[cell] = Region::Inside;
    }
  }
  return regions;
}

} // namespace hybridtree
