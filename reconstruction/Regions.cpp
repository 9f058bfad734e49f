// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Regions.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
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

// Passages are taken in stages, those wider than each of these: at every stage those are left out
// whose sides are one by then, before they are sorted.
constexpr std::array<float, 3> kStages{ 3.0f, 2.0f, 1.5f };

// A facet between two cells.
struct Passage
{
  float size;
  float length;           // longest edge, in world units
  std::int32_t halfFacet; // 4 * cell + facet
  std::int32_t beyond;    // the other cell

  // Greater for wider ones; the same for those within a 256th of an octave: the exponent and eight
  // bits of the fraction.
  std::size_t width() const
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &size, sizeof bits);
    return bits >> 15;
  }
};

struct Passages
{
  std::vector<Passage> mouths; // wider than a mouth
  std::array<std::vector<Passage>, kStages.size() + 1> narrower;

  void add(const Passage& passage, double mouth)
  {
    const auto stage = static_cast<std::size_t>(std::find_if(kStages.begin(), kStages.end(),
                                                  [&](float size) { return passage.size > size; }) -
      kStages.begin());
    (passage.size > mouth ? mouths : narrower[stage]).push_back(passage);
  }
};

// Of all cells, in parts; each part in any order.
std::vector<Passages> widePassages(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double wide, double mouth, const Progress& progress)
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
          const std::int32_t beyond = tetrahedra.neighbor(cell, facet);
          const float size = beyond > cell ? sizes.ofFacet(cell, facet) : 0.0f;
          if (size > wide)
          {
            const auto length = static_cast<float>(sizes.lengthOfFacet(cell, facet));
            part.add({ size, length, 4 * cell + facet, beyond }, mouth);
          }
        }
      }
    });
  return parts;
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
  void prefetch(std::int32_t cell) const
  {
#if defined(__GNUC__)
    __builtin_prefetch(&parent_[cell]);
#endif
  }
  // From now on areOne() knows all joins until here, and may be called by several threads.
  void settle(const Progress& progress)
  {
    settled_.resize(parent_.size());
    parallelFor(parent_.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          std::int32_t root = parent_[cell];
          while (parent_[root] != root)
          {
            root = parent_[root];
          }
          settled_[cell] = root;
        }
      });
    parent_ = settled_;
  }
  bool areOne(std::int32_t a, std::int32_t b) const
  {
    return settled_[a] == settled_[b];
  }
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
  std::vector<std::int32_t> settled_;
  std::vector<double> depth_;
};

// All of them, widest first, those as wide as each other in the order of the parts. By counting.
std::vector<Passage> widestFirst(const std::vector<std::vector<Passage>>& parts)
{
  std::size_t narrowest = std::numeric_limits<std::size_t>::max();
  std::size_t widest = 0;
  for (const std::vector<Passage>& part : parts)
  {
    for (const Passage& passage : part)
    {
      narrowest = std::min(narrowest, passage.width());
      widest = std::max(widest, passage.width());
    }
  }
  if (narrowest > widest)
  {
    return {};
  }
  std::vector<std::size_t> next(widest - narrowest + 2, 0);
  for (const std::vector<Passage>& part : parts)
  {
    for (const Passage& passage : part)
    {
      ++next[widest - passage.width() + 1];
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Passage> sorted(next.back());
  for (const std::vector<Passage>& part : parts)
  {
    for (const Passage& passage : part)
    {
      sorted[next[widest - passage.width()]++] = passage;
    }
  }
  return sorted;
}

// Those of a stage that may join something, widest first.
std::vector<Passage> stillApart(const std::vector<Passages>& parts, std::size_t stage,
  const Basins& basins, const Progress& progress)
{
  std::vector<std::vector<Passage>> apart(parts.size());
  parallelFor(parts.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        const std::vector<Passage>& all = parts[k].narrower[stage];
        std::copy_if(all.begin(), all.end(), std::back_inserter(apart[k]),
          [&](const Passage& p) { return !basins.areOne(p.halfFacet >> 2, p.beyond); });
      }
    });
  progress.check();
  return widestFirst(apart);
}

} // namespace

std::vector<Region> findRegions(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double wide, double mouth, const Progress& progress)
{
  Basins basins(tetrahedra, sizes, progress);
  const std::vector<Passages> parts = widePassages(tetrahedra, sizes, wide, mouth, progress);
  std::size_t step = 0;
  const auto breathe = [&]
  {
    if (++step % kBreath == 0)
    {
      progress.check();
    }
  };
  const auto join = [&](const std::vector<Passage>& passages, bool always)
  {
    constexpr std::size_t kAhead = 16;
    for (std::size_t k = 0; k < passages.size(); ++k)
    {
      breathe();
      const Passage& ahead = passages[std::min(k + kAhead, passages.size() - 1)];
      basins.prefetch(ahead.halfFacet >> 2);
      basins.prefetch(ahead.beyond);
      const std::int32_t here = basins.find(passages[k].halfFacet >> 2);
      const std::int32_t there = basins.find(passages[k].beyond);
      if (here != there &&
        (always || std::min(basins.depth(here), basins.depth(there)) < kDepth * passages[k].length))
      {
        basins.join(here, there);
      }
    }
  };
  for (const Passages& part : parts)
  {
    join(part.mouths, true);
  }
  for (std::size_t stage = 0; stage <= kStages.size(); ++stage)
  {
    basins.settle(progress);
    join(stillApart(parts, stage, basins, progress), false);
  }
  std::vector<Region> regions(tetrahedra.cellCount(), Region::Outside);
  const std::int32_t outside = basins.find(tetrahedra.finiteCellCount());
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    breathe();
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
