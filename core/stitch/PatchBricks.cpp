// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchBricks.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/polygonize/EdgeRoots.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kPointsPerRun = 1000;
constexpr std::int64_t kBricksAlongRun = 4;
constexpr int kHalo = kBrickSide + 2;

/// Marks of the cells of a brick and of those one cell around it: bit x + 1 of row (y + 1, z + 1).
struct Halo
{
  std::uint16_t rows[kHalo][kHalo] = {};
};

Halo gather(const PatchBrick& brick, const std::vector<PatchBrick>& bricks)
{
  Halo halo;
  for (int z = -1; z <= kBrickSide; ++z)
  {
    for (int y = -1; y <= kBrickSide; ++y)
    {
      const int nz = (z + kBrickSide) / kBrickSide;
      const int ny = (y + kBrickSide) / kBrickSide;
      const auto row = [&](int nx) -> unsigned
      {
        const std::int32_t near = brick.near[nx + 3 * (ny + 3 * nz)];
        return near < 0 ? 0u
                        : static_cast<unsigned>(bricks[near].cells[(z + kBrickSide) % kBrickSide] >>
                              (kBrickSide * ((y + kBrickSide) % kBrickSide)) &
                            0xffu);
      };
      halo.rows[z + 1][y + 1] =
        static_cast<std::uint16_t>(row(0) >> (kBrickSide - 1) | row(1) << 1 | (row(2) & 1u) << 9);
    }
  }
  return halo;
}

/// Of its lattice points, or beyond it.
Index3 firstPoint(const PatchBrick& brick, std::int64_t beyond)
{
  return { kBrickSide * brick.index[0] + beyond, kBrickSide * brick.index[1] + beyond,
    kBrickSide * brick.index[2] + beyond };
}

} // namespace

std::int32_t PatchBrick::vertexOn(unsigned axis, int x, int y, int z) const
{
  const std::uint64_t before = (std::uint64_t(1) << (kBrickSide * y + x)) - 1;
  return firstVertex + rank[axis][z] +
    static_cast<std::int32_t>(bitCount(crossed[axis][z] & before));
}

void PatchBrick::countVertices()
{
  vertexCount = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    for (int z = 0; z < kBrickSide; ++z)
    {
      rank[axis][z] = static_cast<std::uint16_t>(vertexCount);
      vertexCount += static_cast<std::int32_t>(bitCount(crossed[axis][z]));
    }
  }
}

PatchBricks::PatchBricks(
  const FieldSource& field, const CellSet& cells, const Lattice& lattice, const Progress& progress)
  : field_(field), lattice_(lattice)
{
  this->addBricks(cells);
  std::vector<BrickBits> within;
  for (PatchBrick& brick : bricks_)
  {
    this->findBits(brick);
    within.push_back(brick.points);
    for (int z = 0; z < kBrickSide; ++z)
    {
      within.back()[z] &= ~brick.border[z];
    }
  }
  this->findRuns();
  this->forEachRun(progress,
    [&](const Run& run)
    {
      this->narrow(run);
      this->ask(run, within, true);
    });
}

template <class Body>
void PatchBricks::forEachRun(const Progress& progress, Body&& body)
{
  parallelFor(runs_.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        body(runs_[k]);
      }
    });
}

/// Corners of a cell lie in its brick and those after it.
void PatchBricks::addBricks(const CellSet& cells)
{
  CellSet all = cells;
  for (const CellSet::Brick& brick : cells.bricks())
  {
    for (int n = 1; n < 8; ++n)
    {
      const Index3 next{ brick.index[0] + (n & 1), brick.index[1] + (n >> 1 & 1),
        brick.index[2] + (n >> 2 & 1) };
      all.insertBlock({ kBrickSide * next[0], kBrickSide * next[1], kBrickSide * next[2] }, 0);
    }
  }
  all.sort();
  bricks_.resize(all.bricks().size());
  for (std::size_t k = 0; k < bricks_.size(); ++k)
  {
    bricks_[k].index = all.bricks()[k].index;
    bricks_[k].cells = all.bricks()[k].bits;
    index_[bricks_[k].index] = static_cast<std::int32_t>(k);
  }
  for (PatchBrick& brick : bricks_)
  {
    for (int n = 0; n < 27; ++n)
    {
      const auto found = index_.find(
        { brick.index[0] + n % 3 - 1, brick.index[1] + n / 3 % 3 - 1, brick.index[2] + n / 9 - 1 });
      brick.near[n] = found == index_.end() ? -1 : found->second;
    }
  }
}

void PatchBricks::findBits(PatchBrick& brick) const
{
  const Halo halo = gather(brick, bricks_);
  for (int z = 0; z < kBrickSide; ++z)
  {
    for (int y = 0; y < kBrickSide; ++y)
    {
      // Cells (x, ...) in bit x + 1, and those before along x brought there too.
      const unsigned r[4] = { halo.rows[z][y], halo.rows[z][y + 1], halo.rows[z + 1][y],
        halo.rows[z + 1][y + 1] };
      const auto put = [y](std::uint64_t& word, unsigned row)
      { word |= std::uint64_t(row >> 1 & 0xffu) << (kBrickSide * y); };
      const unsigned any = r[0] | r[1] | r[2] | r[3];
      const unsigned all = r[0] & r[1] & r[2] & r[3];
      const unsigned points = any | any << 1;
      put(brick.points[z], points);
      put(brick.border[z], points & ~(all & all << 1));
      put(brick.edges[0][z], any);
      put(brick.inner[0][z], all);
      const unsigned anyY = r[1] | r[3];
      const unsigned allY = r[1] & r[3];
      put(brick.edges[1][z], anyY | anyY << 1);
      put(brick.inner[1][z], allY & allY << 1);
      const unsigned anyZ = r[2] | r[3];
      const unsigned allZ = r[2] & r[3];
      put(brick.edges[2][z], anyZ | anyZ << 1);
      put(brick.inner[2][z], allZ & allZ << 1);
    }
  }
}

/// Sides of a layer of points, in the brick so many beyond along x and y; z up to the side of one.
std::uint64_t PatchBricks::sides(const PatchBrick& brick, int dx, int dy, int z) const
{
  const std::int32_t near = brick.near[(1 + dx) + 3 * (1 + dy) + 9 * (1 + z / kBrickSide)];
  return near < 0 ? 0 : bricks_[near].inside[z % kBrickSide];
}

void PatchBricks::findCrossed(PatchBrick& brick) const
{
  constexpr std::uint64_t kLast = 0x8080808080808080u; // of each row
  const auto alongX = [](std::uint64_t row, std::uint64_t next)
  { return (row >> 1 & ~kLast) | (next << (kBrickSide - 1) & kLast); };
  const auto alongY = [](std::uint64_t layer, std::uint64_t next)
  { return layer >> kBrickSide | next << (kBrickSide * (kBrickSide - 1)); };
  std::uint64_t any = 0; // of the layer before: cells with a corner inside there,
  std::uint64_t all = 0; // and those with all four
  std::uint64_t before = 0;
  for (int z = 0; z <= kBrickSide; ++z)
  {
    const std::uint64_t here = this->sides(brick, 0, 0, z);
    const std::uint64_t beyond = this->sides(brick, 0, 1, z);
    const std::uint64_t nextX = alongX(here, this->sides(brick, 1, 0, z));
    const std::uint64_t nextXY = alongX(beyond, this->sides(brick, 1, 1, z));
    const std::uint64_t anyHere = here | nextX | alongY(here | nextX, beyond | nextXY);
    const std::uint64_t allHere = here & nextX & alongY(here & nextX, beyond & nextXY);
    if (z > 0)
    {
      brick.crossed[2][z - 1] = brick.inner[2][z - 1] & (before ^ here);
      brick.mixed[z - 1] = brick.cells[z - 1] & (any | anyHere) & ~(all & allHere);
    }
    if (z < kBrickSide)
    {
      brick.crossed[0][z] = brick.inner[0][z] & (here ^ nextX);
      brick.crossed[1][z] = brick.inner[1][z] & (here ^ alongY(here, beyond));
    }
    before = here;
    any = anyHere;
    all = allHere;
  }
}

/// Up to some number of points and a few bricks wide, so that the field can still be narrowed.
void PatchBricks::findRuns()
{
  std::size_t points = 0;
  Index3 low{}, high{};
  for (std::size_t k = 0; k < bricks_.size(); ++k)
  {
    const PatchBrick& brick = bricks_[k];
    std::size_t own = 0;
    for (const std::uint64_t word : brick.points)
    {
      own += bitCount(word);
    }
    bool joins = k > 0 && points + own <= kPointsPerRun;
    for (int axis = 0; axis < 3 && joins; ++axis)
    {
      joins = std::max(high[axis], brick.index[axis]) - std::min(low[axis], brick.index[axis]) <
        kBricksAlongRun;
    }
    if (!joins)
    {
      runs_.push_back({ k, k });
      points = 0;
      low = high = brick.index;
    }
    points += own;
    runs_.back().end = k + 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], brick.index[axis]);
      high[axis] = std::max(high[axis], brick.index[axis]);
    }
  }
}

/// Finds the part of the field that reaches a run.
void PatchBricks::narrow(const Run& run)
{
  Box3 box;
  for (std::size_t k = run.begin; k < run.end; ++k)
  {
    PatchBrick& brick = bricks_[k];
    if (brick.points != BrickBits{})
    {
      brick.values.assign(kBrickPoints, static_cast<float>(-kThreshold));
      box.extend(lattice_.point(firstPoint(brick, 0)));
      box.extend(lattice_.point(firstPoint(brick, kBrickSide)));
    }
  }
  const FieldSourcePtr source = box.isEmpty() ? nullptr : field_.restrictedTo(box);
  for (std::size_t k = run.begin; k < run.end; ++k)
  {
    bricks_[k].source = bricks_[k].values.empty() ? nullptr : source;
  }
}

void PatchBricks::ask(
  const std::vector<BrickBits>& points, bool tellSides, const Progress& progress)
{
  this->forEachRun(progress, [&](const Run& run) { this->ask(run, points, tellSides); });
}

void PatchBricks::ask(const Run& run, const std::vector<BrickBits>& points, bool tellSides)
{
  struct Chosen
  {
    PatchBrick* brick;
    int point;
  };
  std::vector<Chosen> chosen;
  for (std::size_t k = run.begin; k < run.end; ++k)
  {
    PatchBrick& brick = bricks_[k];
    for (int z = 0; z < kBrickSide; ++z)
    {
      std::uint64_t word = points[k][z] & brick.points[z] & ~brick.known[z];
      brick.known[z] |= word;
      for (; word != 0; word &= word - 1)
      {
        chosen.push_back({ &brick, kBrickSide * kBrickSide * z + CellSet::lowestBit(word) });
      }
    }
  }
  if (chosen.empty() || !chosen.front().brick->source)
  {
    return;
  }
  ScratchVectors places(chosen.size());
  ScratchArray values(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    const int n = chosen[k].point;
    Index3 at = firstPoint(*chosen[k].brick, 0);
    at[0] += n % kBrickSide;
    at[1] += n / kBrickSide % kBrickSide;
    at[2] += n / (kBrickSide * kBrickSide);
    places.batch().set(k, lattice_.point(at));
  }
  chosen.front().brick->source->field(places.points(), values.data());
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    const double value = values[k] - kThreshold;
    const auto [brick, n] = chosen[k];
    brick->values[n] = static_cast<float>(value);
    if (tellSides)
    {
      brick->inside[n / 64] |= std::uint64_t(hybridtree::isInside(value)) << (n % 64);
    }
  }
}

void PatchBricks::askAtCrossed(const Progress& progress)
{
  std::vector<BrickBits> ends(bricks_.size());
  for (std::size_t k = 0; k < bricks_.size(); ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      PatchBrick::forEachCell(bricks_[k].crossed[axis],
        [&](std::array<int, 3> at)
        {
          for (int end = 0; end < 2; ++end, ++at[axis])
          {
            const Place place = this->locate(bricks_[k], at[0], at[1], at[2]);
            ends[place.brick - bricks_.data()][place.z] |= std::uint64_t(1)
              << (kBrickSide * place.y + place.x);
          }
        });
    }
  }
  this->ask(ends, false, progress);
}

PatchBricks::Place PatchBricks::locate(const Index3& index)
{
  const Index3 brick = brickOf(index);
  const auto found = index_.find(brick);
  return { found == index_.end() ? nullptr : &bricks_[found->second],
    static_cast<int>(index[0] - kBrickSide * brick[0]),
    static_cast<int>(index[1] - kBrickSide * brick[1]),
    static_cast<int>(index[2] - kBrickSide * brick[2]) };
}

bool PatchBricks::isInside(const PatchBrick& brick, int x, int y, int z)
{
  const Place place = this->locate(brick, x, y, z);
  return place.brick && PatchBrick::has(place.brick->inside, place.x, place.y, place.z);
}

bool PatchBricks::isMarked(const PatchBrick& brick, const std::array<int, 3>& cell)
{
  const Place place = this->locate(brick, cell[0], cell[1], cell[2]);
  return place.brick && PatchBrick::has(place.brick->cells, place.x, place.y, place.z);
}

unsigned PatchBricks::caseOf(const PatchBrick& brick, const std::array<int, 3>& cell)
{
  if (std::max({ cell[0], cell[1], cell[2] }) < kBrickSide - 1)
  {
    return PatchBrick::corners(brick.inside, cell[0], cell[1], cell[2]);
  }
  unsigned signs = 0;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    signs |=
      unsigned(this->isInside(brick, cell[0] + static_cast<int>(corner & 1u),
        cell[1] + static_cast<int>(corner >> 1 & 1u), cell[2] + static_cast<int>(corner >> 2 & 1u)))
      << corner;
  }
  return signs;
}

} // namespace hybridtree
