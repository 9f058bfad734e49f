// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Sides.h"

#include "reconstruction/ParallelSort.h"
#include "reconstruction/Poles.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// A region whose longest edge is less than this many times as long as that of the way into it is no
// region of its own. Plain lengths: sizes relative to the sampling jump from point to point.
constexpr double kDepth = 1.25;
// What poles count for that see no farther than walls of the sampling may be thick: more would cut
// through these. From kFar spacings on they count in full.
constexpr double kNear = 0.7;
constexpr double kFar = 12.0;
// Poles that see less tell nothing.
constexpr double kLeastPoles = 2.0;
// Known normals come before any way as wide as what they see, but for much wider ones.
constexpr double kNormals = 3.0;

constexpr std::size_t kGrain = 4096;
// How many steps between two looks at whether to go on.
constexpr std::size_t kBreath = 65536;

// Two cells to be joined.
struct Passage
{
  static constexpr std::int32_t kAlike = -1;
  static constexpr std::int32_t kOpposite = -2;

  double size;
  std::int32_t cell;
  std::int32_t facet; // behind which is the other; or kAlike, kOpposite
  std::int32_t other; // where no facet is between
  bool operator<(const Passage& other) const
  {
    return size != other.size ? size > other.size
      : cell != other.cell    ? cell < other.cell
                              : facet < other.facet;
  }
};

std::vector<Passage> widePassages(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double wide, const Progress& progress)
{
  const auto count = static_cast<std::size_t>(tetrahedra.finiteCellCount());
  std::vector<std::vector<Passage>> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (auto cell = static_cast<std::int32_t>(begin); cell < static_cast<std::int32_t>(end);
           ++cell)
      {
        for (int facet = 0; facet < 4; ++facet)
        {
          const double size =
            tetrahedra.neighbor(cell, facet) > cell ? sizes.ofFacet(cell, facet) : 0.0;
          if (size > wide)
          {
            parts[begin / kGrain].push_back({ size, cell, facet, -1 });
          }
        }
      }
    });
  std::vector<Passage> passages;
  for (std::vector<Passage>& part : parts)
  {
    passages.insert(passages.end(), part.begin(), part.end());
    std::vector<Passage>().swap(part);
  }
  return passages;
}

// From infinite cell to infinite cell, where the hull does not turn sharply.
void addHullPassages(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, std::vector<Passage>& passages)
{
  constexpr double kSmooth = 0.8; // cosine
  for (std::int32_t cell = tetrahedra.finiteCellCount(); cell < tetrahedra.cellCount(); ++cell)
  {
    for (std::int32_t facet = 0; facet < 4; ++facet)
    {
      const std::int32_t other = tetrahedra.neighbor(cell, facet);
      if (tetrahedra.finite(other) || other < cell)
      {
        continue;
      }
      const double cosine = hullNormal(tetrahedra, cell).dot(hullNormal(tetrahedra, other));
      if (cosine > kSmooth)
      {
        const int hull = tetrahedra.indexOf(cell, Tetrahedralization::kInfinite);
        const double size =
          sizes.ofFacet(tetrahedra.neighbor(cell, hull), tetrahedra.mirror(cell, hull));
        passages.push_back({ size / (1.05 - cosine), cell, Passage::kAlike, other });
      }
    }
  }
}

void addPoles(const std::vector<Poles>& poles, double weight, std::vector<Passage>& passages)
{
  for (const Poles& pair : poles)
  {
    if (pair.up >= 0 && pair.down >= 0)
    {
      const double share =
        std::clamp(weight * pair.strength / kFar, std::min(kNear, weight), weight);
      passages.push_back({ share * pair.strength, pair.up, Passage::kOpposite, pair.down });
    }
  }
}

// For an open surface, where nothing else says what is outside.
void addNormals(const std::vector<Poles>& poles, const std::vector<Vec3>& normals,
  std::int32_t outside, std::vector<Passage>& passages)
{
  for (std::size_t point = 0; point < poles.size(); ++point)
  {
    const Poles& pair = poles[point];
    const bool known = normals[point] != Vec3::Zero();
    if (known && pair.up >= 0)
    {
      passages.push_back({ kNormals * pair.strength, pair.up, Passage::kAlike, outside });
    }
    if (known && pair.down >= 0)
    {
      passages.push_back({ kNormals * pair.strength, pair.down, Passage::kOpposite, outside });
    }
  }
}

// Disjoint sets of cells, each of two colours, that know the longest edge of either. One more cell
// stands for the outside.
class Basins
{
public:
  struct Side
  {
    std::int32_t root;
    std::uint8_t colour; // 0: that of the root
    bool operator==(const Side& other) const
    {
      return root == other.root && colour == other.colour;
    }
  };

  Basins(const Tetrahedralization& tetrahedra, const FacetSize& sizes, const Progress& progress)
    : parent_(tetrahedra.cellCount() + 1)
    , unlike_(parent_.size(), 0)
    , size_(parent_.size(), 1)
    , depth_(parent_.size(), { 0.0, 0.0 })
  {
    std::iota(parent_.begin(), parent_.end(), 0);
    parallelFor(static_cast<std::size_t>(tetrahedra.finiteCellCount()), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          depth_[cell][0] = sizes.lengthOfCell(static_cast<std::int32_t>(cell));
        }
      });
    for (auto cell = static_cast<std::size_t>(tetrahedra.finiteCellCount()); cell < depth_.size();
         ++cell)
    {
      depth_[cell][0] = std::numeric_limits<double>::infinity();
    }
  }

  Side find(std::int32_t cell)
  {
    Side side{ cell, 0 };
    while (parent_[side.root] != side.root)
    {
      side.colour ^= unlike_[side.root];
      side.root = parent_[side.root];
    }
    std::uint8_t colour = side.colour;
    while (cell != side.root)
    {
      const std::int32_t next = parent_[cell];
      const std::uint8_t unlike = unlike_[cell];
      parent_[cell] = side.root;
      unlike_[cell] = colour;
      colour ^= unlike;
      cell = next;
    }
    return side;
  }

  double depth(Side side) const { return depth_[side.root][side.colour]; }

  void join(Side a, Side b, bool opposite)
  {
    if (size_[a.root] < size_[b.root])
    {
      std::swap(a, b);
    }
    const auto unlike = static_cast<std::uint8_t>(a.colour ^ b.colour ^ (opposite ? 1 : 0));
    parent_[b.root] = a.root;
    unlike_[b.root] = unlike;
    size_[a.root] += size_[b.root];
    for (std::size_t colour = 0; colour < 2; ++colour)
    {
      double& depth = depth_[a.root][colour ^ unlike];
      depth = std::max(depth, depth_[b.root][colour]);
    }
  }

private:
  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> unlike_; // the parent's colour
  std::vector<std::int32_t> size_;
  std::vector<std::array<double, 2>> depth_;
};

// The widest first.
void joinAll(const std::vector<Passage>& passages, const Tetrahedralization& tetrahedra,
  const FacetSize& sizes, double mouth, Basins& basins, const Progress& progress)
{
  std::size_t step = 0;
  for (const Passage& passage : passages)
  {
    if (++step % kBreath == 0)
    {
      progress.check();
    }
    const bool through = passage.facet >= 0;
    const Basins::Side here = basins.find(passage.cell);
    const Basins::Side there =
      basins.find(through ? tetrahedra.neighbor(passage.cell, passage.facet) : passage.other);
    if (here.root == there.root)
    {
      continue;
    }
    const double shallow = std::min(basins.depth(here), basins.depth(there));
    if (!through || passage.size > mouth ||
      shallow < kDepth * sizes.lengthOfFacet(passage.cell, passage.facet))
    {
      basins.join(here, there, passage.facet == Passage::kOpposite);
    }
  }
}

// Where no normal has told: the colour that most of the hull has.
Basins::Side outsideOf(const Tetrahedralization& tetrahedra, Basins& basins)
{
  const Basins::Side told = basins.find(tetrahedra.cellCount());
  const Basins::Side first = basins.find(tetrahedra.finiteCellCount());
  if (told.root == first.root)
  {
    return told;
  }
  std::int32_t votes[2] = { 0, 0 };
  for (std::int32_t cell = tetrahedra.finiteCellCount(); cell < tetrahedra.cellCount(); ++cell)
  {
    const Basins::Side side = basins.find(cell);
    votes[side.colour] += side.root == first.root;
  }
  return { first.root, static_cast<std::uint8_t>(votes[1] > votes[0] ? 1 : 0) };
}

} // namespace

std::vector<Region> findSides(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const SideOptions& options, const Progress& progress)
{
  Basins basins(tetrahedra, sizes, progress);
  std::vector<Passage> passages = widePassages(tetrahedra, sizes, options.wide, progress);
  if (options.open)
  {
    addHullPassages(tetrahedra, sizes, passages);
  }
  else
  {
    for (std::int32_t cell = tetrahedra.finiteCellCount(); cell < tetrahedra.cellCount(); ++cell)
    {
      basins.join(basins.find(tetrahedra.cellCount()), basins.find(cell), false);
    }
  }
  const std::vector<Poles> poles =
    findPoles(tetrahedra, sizes, kLeastPoles, options.normals, progress);
  addPoles(poles, options.poles, passages);
  if (options.open && options.normals)
  {
    addNormals(poles, *options.normals, tetrahedra.cellCount(), passages);
  }
  parallelSort(passages, progress);
  joinAll(passages, tetrahedra, sizes, options.mouth, basins, progress);

  std::vector<Region> regions(tetrahedra.cellCount(), Region::Inside);
  const Basins::Side outside = outsideOf(tetrahedra, basins);
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    if (cell % static_cast<std::int32_t>(kBreath) == 0)
    {
      progress.check();
    }
    if (tetrahedra.finite(cell) && sizes.ofCell(cell) <= options.wide)
    {
      regions[cell] = Region::Surface;
    }
    else if (basins.find(cell) == outside)
    {
      regions[cell] = Region::Outside;
    }
  }
  return regions;
}

} // namespace hybridtree
