// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Stitch.h"

#include "core/base/DisjointSets.h"
#include "core/base/LargestFirst.h"
#include "core/base/RecentStore.h"
#include "core/polygonize/MemoryBudget.h"
#include "core/stitch/Assemble.h"
#include "core/stitch/CellIslands.h"
#include "core/stitch/Island.h"
#include "core/stitch/KeptMesh.h"
#include "core/stitch/LocalParts.h"

#include <algorithm>
#include <map>

namespace hybridtree
{
namespace
{

constexpr std::size_t kRememberedBytes = std::size_t(256) << 20;

// Around the cells, within which all that an island asks of the field lies.
constexpr double kMargin = 5.0;

// As in makePatch(), over all islands.
constexpr double kBytesPerBrick = 20000.0;

/// All that an island depends on.
struct IslandKey
{
  CellGrid grid;
  std::vector<CellSet::Brick> cells;
  std::vector<Dependency> dependencies; ///< of the field, then the parts

  bool operator==(const IslandKey& other) const
  {
    return grid == other.grid && cells == other.cells && dependencies == other.dependencies;
  }

  bool isExpired() const { return anyExpired(dependencies); }

  std::uint64_t hash() const
  {
    HashSum sum;
    for (const CellSet::Brick& brick : cells)
    {
      sum.add(Index3Hash()(brick.index));
      for (const std::uint64_t word : brick.bits)
      {
        sum.add(word);
      }
    }
    for (const Dependency& dependency : dependencies)
    {
      dependency.addTo(sum);
    }
    return sum.value();
  }
};

using IslandStore = RecentStore<IslandKey, Island>;

IslandStore& store()
{
  static IslandStore* const instance = new IslandStore(kRememberedBytes); // outlives all statics
  return *instance;
}

/// Rims of islands that touched others and became one with them. At each edit those would be cut
/// again only to find that they touch.
using RimStore = RecentStore<IslandKey, std::vector<PartPoint>>;

RimStore& rimStore()
{
  constexpr std::size_t kMostBytes = std::size_t(32) << 20;
  static RimStore* const instance = new RimStore(kMostBytes); // outlives all statics
  return *instance;
}

/// The same as the key of an island by what the parts are near it, where their objects are new.
struct LocalIslandKey
{
  CellGrid grid;
  std::vector<CellSet::Brick> cells;
  std::vector<Dependency> known; ///< of the field, then the leaves among the parts
  Contents parts;
  std::uint64_t sum = 0; ///< hash of it all

  bool operator==(const LocalIslandKey& other) const
  {
    return sum == other.sum && grid == other.grid && cells == other.cells && known == other.known &&
      parts == other.parts;
  }
  bool isExpired() const { return anyExpired(known); }
  std::uint64_t hash() const { return sum; }
};

using LocalIslandStore = RecentStore<LocalIslandKey, Island>;

LocalIslandStore& localStore()
{
  static auto* const instance = new LocalIslandStore(kRememberedBytes); // outlives all statics
  return *instance;
}

/// A field without parts. Its islands are forgotten with it.
class WholeField final : public IslandField
{
public:
  explicit WholeField(const FieldSource& field) : field_(field) {}

  Near near(const std::vector<Box3>&) const override
  {
    return { FieldSourcePtr(FieldSourcePtr(), &field_), { { self_, 0.0, 0 } } };
  }

  void findSources(TriangleMesh&, const Progress&) const override {}

private:
  const FieldSource& field_;
  const std::shared_ptr<const int> self_ = std::make_shared<const int>(0);
};

/// One island on its way from cells to triangles.
struct Work
{
  CellSet cells;
  Box3 box; ///< of the cells, and a margin
  std::vector<std::int32_t> numbers;
  std::vector<KeptPart> parts; ///< those of these numbers, which are near
  IslandField::Near near;
  IslandKey key;
  std::optional<LocalParts> local; ///< once it is not known by its key
  LocalIslandKey localKey;
  std::optional<IslandCut> cut;
  RimStore::ValuePtr knownRim; ///< of the cut, which then is made only if it is needed
  std::shared_ptr<const Island> island;
  double begin = 0.0; ///< its part in the progress of all islands
  double end = 0.0;

  const std::vector<PartPoint>& rim() const
  {
    return island ? island->rim : knownRim ? *knownRim : cut->rim;
  }
};

class Stitcher
{
public:
  Stitcher(const IslandField& field, const std::vector<KeptPart>& parts,
    const StitchOptions& options, const Progress& progress)
    : field_(field), parts_(parts), options_(options), progress_(progress)
  {
    for (const KeptPart& part : parts)
    {
      bounds_.push_back(KeptMesh::of(part.mesh)->bounds());
    }
  }

  /// Islands over all cells, which may have faults.
  void make(const CellSet& cells)
  {
    const auto bricks = static_cast<double>(cells.bricks().size());
    MemoryBudget{ options_.maxBytes, options_.grid.cellSize }.check(
      bricks * kBytesPerBrick, bricks * kBrickPoints);
    std::vector<Work> before = std::move(works_);
    works_.clear();
    for (CellSet& island : islandsOf(cells))
    {
      const auto same = std::find_if(before.begin(), before.end(),
        [&](const Work& work) { return work.cells.bricks() == island.bricks(); });
      works_.push_back(same == before.end() ? Work() : std::move(*same));
      works_.back().cells = std::move(island);
    }
    this->forEachWork(
      [this](Work& work)
      {
        if (!work.island)
        {
          work = this->prepare(std::move(work.cells));
          this->recall(work);
        }
      });
    do
    {
      this->forEachWork([this](Work& work) { this->cut(work); });
    } while (this->uniteTouching()); // those of united islands may reach farther
    remembered_ = made_ ? remembered_
                        : static_cast<std::size_t>(std::count_if(works_.begin(), works_.end(),
                            [](const Work& work) { return work.island != nullptr; }));
    made_ = true;
    this->shareProgress();
    this->forEachWork([this](Work& work) { this->finish(work); });
  }

  std::vector<Index3> faults() const
  {
    std::vector<Index3> faults;
    for (const Work& work : works_)
    {
      faults.insert(faults.end(), work.island->faults.begin(), work.island->faults.end());
    }
    return faults;
  }

  StitchedMesh assembled() const
  {
    std::vector<PlacedIsland> islands;
    for (const Work& work : works_)
    {
      islands.push_back({ work.island, work.numbers });
    }
    StitchedMesh result = assemble(parts_, islands);
    result.islands = works_.size();
    result.remembered = remembered_;
    return result;
  }

private:
  /// What is still to be made takes time by its cells.
  void shareProgress()
  {
    double cells = 0.0;
    for (Work& work : works_)
    {
      work.begin = cells;
      cells += work.island ? 0.0 : static_cast<double>(work.cells.size());
      work.end = cells;
    }
    for (Work& work : works_)
    {
      work.begin /= std::max(cells, 1.0);
      work.end /= std::max(cells, 1.0);
    }
  }

  template <typename Body>
  void forEachWork(Body&& body)
  {
    std::vector<std::size_t> sizes;
    for (const Work& work : works_)
    {
      sizes.push_back(work.cells.bricks().size());
    }
    forLargestFirst(sizes,
      [&](std::size_t k)
      {
        progress_.check();
        body(works_[k]);
      });
  }

  Work prepare(CellSet cells) const
  {
    Work work;
    std::vector<Box3> boxes;
    for (const CellSet::Brick& brick : cells.bricks())
    {
      const Index3 low{ kBrickSide * brick.index[0], kBrickSide * brick.index[1],
        kBrickSide * brick.index[2] };
      boxes.push_back(options_.grid.boxOf(low, kBrickSide, kMargin));
      work.box.extend(boxes.back());
    }
    work.near = field_.near(boxes);
    work.key = { options_.grid, cells.bricks(), work.near.dependencies };
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      if (bounds_[p].intersects(work.box))
      {
        work.numbers.push_back(static_cast<std::int32_t>(p));
        work.parts.push_back(parts_[p]);
        work.key.dependencies.emplace_back(
          parts_[p].mesh, parts_[p].isLeaf ? 1.0 : 0.0, parts_[p].firstLeaf);
      }
    }
    work.cells = std::move(cells);
    return work;
  }

  /// Takes an island that was made before of the same objects, or of what is the same near it.
  void recall(Work& work) const
  {
    work.island = store().find(work.key);
    if (work.island)
    {
      return;
    }
    work.local.emplace(work.parts, work.cells, options_.grid);
    LocalIslandKey& key = work.localKey;
    key = { options_.grid, work.key.cells, work.near.dependencies, {}, 0 };
    for (const KeptPart& part : work.parts)
    {
      if (part.isLeaf)
      {
        key.known.emplace_back(part.mesh, 0.0, part.firstLeaf);
      }
    }
    work.local->describe(key.parts);
    HashSum sum;
    sum.add(key.parts.hash());
    for (const CellSet::Brick& brick : key.cells)
    {
      sum.add(Index3Hash()(brick.index));
    }
    for (const Dependency& dependency : key.known)
    {
      dependency.addTo(sum);
    }
    key.sum = sum.value();
    if (const std::shared_ptr<const Island> known = localStore().find(key))
    {
      work.island = std::make_shared<const Island>(work.local->fromPlaces(*known));
      this->remember(work);
    }
  }

  static std::size_t bytesOf(const IslandKey& key)
  {
    return key.cells.size() * sizeof(CellSet::Brick) + key.dependencies.size() * sizeof(Dependency);
  }

  static void remember(const Work& work)
  {
    store().keep(work.key, work.island, work.island->bytes() + bytesOf(work.key));
  }

  static void rememberRim(Work& work)
  {
    if (work.cut)
    {
      auto rim = std::make_shared<const std::vector<PartPoint>>(std::move(work.cut->rim));
      const std::size_t bytes = rim->size() * sizeof(PartPoint) + bytesOf(work.key);
      rimStore().keep(std::move(work.key), std::move(rim), bytes);
    }
  }

  /// Islands that cut triangles at a common point become one. \return whether there are such.
  bool uniteTouching()
  {
    std::map<PartPoint, std::size_t> first;
    DisjointSets sets(works_.size());
    bool any = false;
    for (std::size_t k = 0; k < works_.size(); ++k)
    {
      for (const PartPoint& at : works_[k].rim())
      {
        const PartPoint known{ works_[k].numbers[at.part], at.point };
        const auto [found, isNew] = first.emplace(known, k);
        any = any || (!isNew && found->second != k);
        sets.join(static_cast<std::uint32_t>(found->second), static_cast<std::uint32_t>(k));
      }
    }
    if (!any)
    {
      return false;
    }
    std::vector<Work> united;
    std::vector<CellSet> cells(works_.size());
    for (std::size_t k = 0; k < works_.size(); ++k)
    {
      cells[sets.find(static_cast<std::uint32_t>(k))].insert(works_[k].cells);
    }
    for (std::size_t k = 0; k < works_.size(); ++k)
    {
      if (cells[k].size() == works_[k].cells.size())
      {
        united.push_back(std::move(works_[k]));
        continue;
      }
      Stitcher::rememberRim(works_[k]);
      if (!cells[k].empty())
      {
        cells[k].sort();
        united.push_back(this->prepare(std::move(cells[k])));
        this->recall(united.back());
      }
    }
    works_ = std::move(united);
    return true;
  }

  /// Unless all that is asked of the cut is known.
  void cut(Work& work) const
  {
    if (!work.island && !work.cut && !work.knownRim)
    {
      work.knownRim = rimStore().find(work.key);
      if (!work.knownRim)
      {
        this->makeCut(work);
      }
    }
  }

  void makeCut(Work& work) const
  {
    work.cut = cutIsland(work.parts, work.cells, options_.grid, progress_);
  }

  void finish(Work& work) const
  {
    if (work.island)
    {
      return;
    }
    if (!work.cut)
    {
      this->makeCut(work);
    }
    const bool isLocal = work.local->areAllOf(*work.cut, options_.grid);
    const ProgressPart progress(progress_, work.begin, work.end);
    work.island = std::make_shared<const Island>(makeIsland(
      field_, work.near, work.parts, std::move(*work.cut), work.cells, options_, progress));
    this->remember(work);
    if (isLocal)
    {
      auto island = std::make_shared<const Island>(work.local->toPlaces(*work.island));
      const std::size_t bytes = island->bytes() + work.localKey.parts.bytes() +
        work.localKey.cells.size() * sizeof(CellSet::Brick) +
        work.localKey.known.size() * sizeof(Dependency);
      localStore().keep(std::move(work.localKey), std::move(island), bytes);
    }
  }

  const IslandField& field_;
  const std::vector<KeptPart>& parts_;
  const StitchOptions& options_;
  const Progress& progress_;
  std::vector<Box3> bounds_; ///< of the parts
  std::vector<Work> works_;
  bool made_ = false; ///< once; what is then remembered was made here
  std::size_t remembered_ = 0;
};

/// Marks cells and what is around them, the further the later in the rounds.
void markAround(const std::vector<Index3>& faults, int reach, CellSet& cells)
{
  CellSet more;
  for (const Index3& cell : faults)
  {
    more.insert(cell);
  }
  for (int ring = 0; ring < reach; ++ring)
  {
    more = more.grown();
  }
  cells.insert(more);
}

} // namespace

std::optional<StitchedMesh> stitch(const IslandField& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress)
{
  const ProgressPart making(progress, 0.0, 0.9);
  Stitcher stitcher(field, parts, options, making);
  for (int round = 1; round <= options.maxRounds; ++round)
  {
    cells.fillDiagonals();
    stitcher.make(cells);
    const std::vector<Index3> faults = stitcher.faults();
    progress.report(0.9);
    if (faults.empty())
    {
      StitchedMesh stitched = stitcher.assembled();
      stitched.rounds = round;
      return stitched;
    }
    markAround(faults, round, cells);
  }
  return std::nullopt;
}

std::optional<StitchedMesh> stitch(const FieldSource& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress)
{
  return stitch(WholeField(field), parts, std::move(cells), options, progress);
}

void forgetIslands()
{
  store().clear();
  localStore().clear();
  rimStore().clear();
}

} // namespace hybridtree
