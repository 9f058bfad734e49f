// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Regions.h"

#include "reconstruction/ParallelSort.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// A region whose longest edge is less than this many times as long as that of the way into it is no
// region of its own. Plain lengths: sizes relative to the sampling jump from point to point.
constexpr double kDepth = 1.25;

constexpr std::size_t kGrain = 4096;
// How many steps between two looks at whether to go on.
constexpr std::size_t kBreath = 65536;

// A facet between two cells, by size: widest first where sorted.
struct Passage
{
  float size;
  std::int32_t halfFacet; // 4 * cell + facet
  bool operator<(const Passage& other) const
  {
    return size != other.size ? size > other.size : halfFacet < other.halfFacet;
  }
};

struct Passages
{
  std::vector<std::int32_t> mouths; // half-facets wider than a mouth, in any order
  std::vector<Passage> narrower;    // widest first
};

Passages widePassages(const Tetrahedralization& tetrahedra, const FacetSize& sizes, double wide,
  double mouth, const Progress& progress)
{
  const auto count = static_cast<std::size_t>(tetrahedra.finiteCellCount());
  std::vector<Passages> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      Passages& part = parts[begin / kGrain];
      for (auto cell = static_cast<std::int32_t>(begin); cell < static_cast<std::int32_t>(end);
           ++cell)
      {
        for (int facet = 0; facet < 4; ++facet)
        {
          const float size =
            tetrahedra.neighbor(cell, facet) > cell ? sizes.ofFacet(cell, facet) : 0.0f;
          if (size > mouth)
          {
            part.mouths.push_back(4 * cell + facet);
          }
          else if (size > wide)
          {
            part.narrower.push_back({ size, 4 * cell + facet });
          }
        }
      }
    });
  Passages all;
  for (Passages& part : parts)
  {
    all.mouths.insert(all.mouths.end(), part.mouths.begin(), part.mouths.end());
    all.narrower.insert(all.narrower.end(), part.narrower.begin(), part.narrower.end());
    part = {};
  }
  parallelSort(all.narrower, progress);
  return all;
}

// Disjoint sets of cells that know the longest edge of theirs.
class Basins
{
public:
  Basins(const Tetrahedralization& tetrahedra, const FacetSize& sizes, const Progress& progress)
    : parent_(tetrahedra.cellCount())
    , depth_(tetrahedra.cellCount(), std::numeric_limits<double>::infinity())
  {
    std::iota(parent_.begin(), parent_.end(), 0);
    parallelFor(static_cast<std::size_t>(tetrahedra.finiteCellCount()), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          depth_[cell] = sizes.lengthOfCell(static_cast<std::int32_t>(cell));
        }
      });
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

std::vector<Region> findRegions(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double wide, double mouth, const Progress& progress)
{
  Basins basins(tetrahedra, sizes, progress);
  const Passages passages = widePassages(tetrahedra, sizes, wide, mouth, progress);
  std::size_t step = 0;
  const auto forSides = [&](std::int32_t halfFacet, const auto& visit)
  {
    if (++step % kBreath == 0)
    {
      progress.check();
    }
    const std::int32_t here = basins.find(halfFacet >> 2);
    const std::int32_t there = basins.find(tetrahedra.neighbor(halfFacet >> 2, halfFacet & 3));
    if (here != there)
    {
      visit(here, there);
    }
  };
  for (const std::int32_t halfFacet : passages.mouths)
  {
    forSides(halfFacet, [&](std::int32_t here, std::int32_t there) { basins.join(here, there); });
  }
  for (const Passage& passage : passages.narrower)
  {
    forSides(passage.halfFacet,
      [&](std::int32_t here, std::int32_t there)
      {
        const double length = sizes.lengthOfFacet(passage.halfFacet >> 2, passage.halfFacet & 3);
        if (std::min(basins.depth(here), basins.depth(there)) < kDepth * length)
        {
          basins.join(here, there);
        }
      });
  }
  std::vector<Region> regions(tetrahedra.cellCount(), Region::Outside);
  const std::int32_t outside = basins.find(tetrahedra.finiteCellCount());
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    if (++step % kBreath == 0)
    {
      progress.check();
    }
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
