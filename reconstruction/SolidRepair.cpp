// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SolidRepair.h"

#include "reconstruction/SolidBoundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

enum class Infinity : std::uint8_t
{
  Held, // infinite cells stay as they are
  Free
};

constexpr int kMostFlips = 6;
constexpr std::int32_t kUnknown = -1;
// How many steps between two looks at whether to go on.
constexpr std::size_t kBreath = 65536;

// Cells around one vertex in clumps: those on the same side that hang together by facets.
struct Clump
{
  std::vector<std::int32_t> cells;
  double reach = 0.0; // cubes of the longest edges: long slivers make bridges, so volume misleads
  bool inside = false;
};

class SolidRepair
{
public:
  SolidRepair(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t>& inside, Voids voids,
    Infinity infinity, const Progress& progress)
    : tetrahedra_(tetrahedra)
    , inside_(inside)
    , voids_(voids)
    , infinity_(infinity)
    , progress_(progress)
    , unseen_(inside.size(), 0)
    , flips_(inside.size(), 0)
    , waiting_(tetrahedra.points().size(), 0)
    , excess_(tetrahedra.points().size(), kUnknown)
  {
  }

  std::size_t run()
  {
    this->removeCrumbsAndVoids();
    unmended_ = pinchedVertices(tetrahedra_, inside_, progress_);
    const std::size_t tidy = changes_;
    bool left = true;
    for (mostFlips_ = 1; left && mostFlips_ <= kMostFlips; ++mostFlips_)
    {
      for (leastGain_ = 1; left && leastGain_ >= -3; --leastGain_)
      {
        left = this->mendVertices(&SolidRepair::changeBest);
      }
    }
    if (left)
    {
      this->mendVertices(&SolidRepair::fillStar);
    }
    if (changes_ != tidy)
    {
      this->removeCrumbsAndVoids();
    }
    return changes_;
  }

private:
  using Mend = void (SolidRepair::*)(std::int32_t, const std::vector<Clump>&);

  bool mendVertices(Mend mend);
  void changeBest(std::int32_t vertex, const std::vector<Clump>& clumps);
  bool mayChange(const Clump& clump) const;
  long gain(const Clump& clump, std::int32_t vertex, long least);
  void change(const Clump& clump);
  void fillStar(std::int32_t vertex, const std::vector<Clump>& clumps);
  std::vector<Clump> clumpsAround(std::int32_t vertex);
  std::size_t countClumps(std::int32_t vertex);
  long excess(std::int32_t vertex);
  void flip(const Clump& clump);
  bool onSurface(std::int32_t vertex) const;
  double reach(std::int32_t cell) const;
  bool isHeld(std::int32_t cell) const
  {
    return infinity_ == Infinity::Held && !tetrahedra_.finite(cell);
  }
  void setSide(std::int32_t cell, bool inside);
  void await(std::int32_t vertex);
  std::vector<std::int32_t> component(std::int32_t seed, std::vector<std::uint8_t>& seen) const;
  void removeCrumbsAndVoids();

  const Tetrahedralization& tetrahedra_;
  std::vector<std::uint8_t>& inside_;
  const Voids voids_;
  const Infinity infinity_;
  const Progress& progress_;
  std::vector<std::uint8_t> unseen_; // all 0 between uses
  std::vector<std::int32_t> stack_;
  std::vector<std::uint8_t> flips_;
  std::vector<std::uint8_t> waiting_;
  std::vector<std::int32_t> excess_;   // clumps too many, where they have been counted
  std::vector<std::int32_t> around_;   // vertices of the clump that is tried
  std::vector<std::int32_t> vertices_; // that wait
  std::vector<std::int32_t> unmended_; // that no change was found for
  std::size_t changes_ = 0;
  long leastGain_ = 1; // of a change, in clumps too many
  int mostFlips_ = 1;  // of a cell, for changes that gain nothing
};

double SolidRepair::reach(std::int32_t cell) const
{
  if (this->isHeld(cell))
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto& v = tetrahedra_.cell(cell);
  double longest = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if (v[i] == Tetrahedralization::kInfinite || v[j] == Tetrahedralization::kInfinite)
      {
        continue;
      }
      const Vec3 edge = tetrahedra_.points()[v[i]] - tetrahedra_.points()[v[j]];
      longest = std::max(longest, edge.norm());
    }
  }
  return longest * longest * longest;
}

std::vector<Clump> SolidRepair::clumpsAround(std::int32_t vertex)
{
  const auto star = tetrahedra_.star(vertex);
  std::vector<Clump> clumps;
  std::for_each(star.begin(), star.end(), [this](std::int32_t cell) { unseen_[cell] = 1; });
  for (const std::int32_t seed : star)
  {
    if (!unseen_[seed])
    {
      continue;
    }
    Clump clump;
    clump.inside = inside_[seed] != 0;
    clump.cells.push_back(seed);
    unseen_[seed] = 0;
    for (std::size_t k = 0; k < clump.cells.size(); ++k)
    {
      clump.reach += this->reach(clump.cells[k]);
      for (int facet = 0; facet < 4; ++facet)
      {
        const std::int32_t beyond = tetrahedra_.neighbor(clump.cells[k], facet);
        if (unseen_[beyond] && (inside_[beyond] != 0) == clump.inside)
        {
          unseen_[beyond] = 0;
          clump.cells.push_back(beyond);
        }
      }
    }
    clumps.push_back(std::move(clump));
  }
  return clumps;
}

// How many clumpsAround finds. Nearly all vertices need no more than this.
std::size_t SolidRepair::countClumps(std::int32_t vertex)
{
  const auto star = tetrahedra_.star(vertex);
  std::for_each(star.begin(), star.end(), [this](std::int32_t cell) { unseen_[cell] = 1; });
  std::size_t clumps = 0;
  for (const std::int32_t seed : star)
  {
    if (!unseen_[seed])
    {
      continue;
    }
    ++clumps;
    unseen_[seed] = 0;
    stack_.assign(1, seed);
    while (!stack_.empty())
    {
      const std::int32_t cell = stack_.back();
      stack_.pop_back();
      for (int facet = 0; facet < 4; ++facet)
      {
        const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
        if (unseen_[beyond] && inside_[beyond] == inside_[cell])
        {
          unseen_[beyond] = 0;
          stack_.push_back(beyond);
        }
      }
    }
  }
  return clumps;
}

// Clumps too many around a vertex, as the cells are now.
long SolidRepair::excess(std::int32_t vertex)
{
  return std::max<long>(0, static_cast<long>(this->countClumps(vertex)) - 2);
}

bool SolidRepair::onSurface(std::int32_t vertex) const
{
  const auto star = tetrahedra_.star(vertex);
  return std::any_of(star.begin(), star.end(),
    [&](std::int32_t cell) { return inside_[cell] != inside_[*star.begin()]; });
}

void SolidRepair::await(std::int32_t vertex)
{
  if (!waiting_[vertex])
  {
    waiting_[vertex] = 1;
    vertices_.push_back(vertex);
  }
}

void SolidRepair::setSide(std::int32_t cell, bool inside)
{
  inside_[cell] = inside ? 1 : 0;
  flips_[cell] = static_cast<std::uint8_t>(std::min(flips_[cell] + 1, 255));
  ++changes_;
  for (const std::int32_t vertex : tetrahedra_.cell(cell))
  {
    if (vertex != Tetrahedralization::kInfinite)
    {
      excess_[vertex] = kUnknown;
      this->await(vertex);
    }
  }
}

// Whether vertices are left that no change was found for.
bool SolidRepair::mendVertices(Mend mend)
{
  std::for_each(unmended_.rbegin(), unmended_.rend(), [this](std::int32_t v) { this->await(v); });
  unmended_.clear();
  std::size_t step = 0;
  while (!vertices_.empty())
  {
    const std::int32_t vertex = vertices_.back();
    vertices_.pop_back();
    waiting_[vertex] = 0;
    if (++step % 256 == 0)
    {
      progress_.check();
    }
    if (!this->onSurface(vertex) || this->countClumps(vertex) <= 2)
    {
      continue;
    }
    const std::size_t before = changes_;
    (this->*mend)(vertex, this->clumpsAround(vertex));
    if (changes_ == before)
    {
      unmended_.push_back(vertex);
    }
  }
  return !unmended_.empty();
}

// Of the changes that leave fewer vertices to be mended around here, takes the one that leaves the
// fewest, and of those the one of least reach.
void SolidRepair::changeBest(std::int32_t vertex, const std::vector<Clump>& clumps)
{
  // Trying each cell of a huge star would be quadratic.
  constexpr std::size_t kManyCells = 200;
  const bool single = tetrahedra_.star(vertex).size() <= kManyCells;
  std::vector<Clump> choices;
  Clump filled;
  Clump emptied;
  for (const Clump& clump : clumps)
  {
    Clump& whole = clump.inside ? emptied : filled;
    whole.inside = clump.inside;
    for (const std::int32_t cell : clump.cells)
    {
      if (!this->isHeld(cell))
      {
        whole.cells.push_back(cell);
        whole.reach += this->reach(cell);
        if (single)
        {
          choices.push_back({ { cell }, this->reach(cell), clump.inside });
        }
      }
    }
    if (std::isfinite(clump.reach))
    {
      choices.push_back(clump);
    }
  }
  choices.push_back(filled);
  choices.push_back(emptied);
  const Clump* best = nullptr;
  long bestGain = leastGain_ - 1;
  for (const Clump& choice : choices)
  {
    if (!this->mayChange(choice))
    {
      continue;
    }
    const long gain = this->gain(choice, vertex, best ? bestGain : leastGain_);
    if (gain > bestGain || (gain == bestGain && best && choice.reach < best->reach))
    {
      best = &choice;
      bestGain = gain;
    }
  }
  if (best)
  {
    this->change(*best);
  }
}

bool SolidRepair::mayChange(const Clump& clump) const
{
  return !clump.cells.empty() &&
    (leastGain_ > 0 ||
      std::all_of(clump.cells.begin(), clump.cells.end(),
        [this](std::int32_t cell) { return flips_[cell] < mostFlips_; }));
}

// How many clumps too many there are fewer once the clump, one around the vertex, has changed
// sides. Less than the least, anything that is: most changes are seen to be too little at the
// vertex itself.
long SolidRepair::gain(const Clump& clump, std::int32_t vertex, long least)
{
  around_.clear();
  for (const std::int32_t cell : clump.cells)
  {
    around_.insert(around_.end(), tetrahedra_.cell(cell).begin(), tetrahedra_.cell(cell).end());
  }
  std::sort(around_.begin(), around_.end());
  around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
  around_.erase(
    std::remove(around_.begin(), around_.end(), Tetrahedralization::kInfinite), around_.end());
  std::iter_swap(around_.begin(), std::find(around_.begin(), around_.end(), vertex));
  long gain = 0;
  for (const std::int32_t v : around_)
  {
    if (excess_[v] == kUnknown)
    {
      excess_[v] = static_cast<std::int32_t>(this->excess(v));
    }
    gain += excess_[v];
  }
  this->flip(clump);
  for (std::size_t k = 0; k < around_.size() && gain >= least; ++k)
  {
    gain -= this->excess(around_[k]);
  }
  this->flip(clump);
  return gain;
}

// For a trial: nothing is told of it.
void SolidRepair::flip(const Clump& clump)
{
  for (const std::int32_t cell : clump.cells)
  {
    inside_[cell] ^= 1;
  }
}

void SolidRepair::change(const Clump& clump)
{
  for (const std::int32_t cell : clump.cells)
  {
    this->setSide(cell, !clump.inside);
  }
}

void SolidRepair::fillStar(std::int32_t vertex, const std::vector<Clump>&)
{
  for (const std::int32_t cell : tetrahedra_.star(vertex))
  {
    if (!this->isHeld(cell) && !inside_[cell])
    {
      this->setSide(cell, true);
    }
  }
}

// The cells of one side that hang together with the seed, which are seen then.
std::vector<std::int32_t> SolidRepair::component(
  std::int32_t seed, std::vector<std::uint8_t>& seen) const
{
  constexpr std::size_t kAhead = 16;
  const bool side = inside_[seed] != 0;
  std::vector<std::int32_t> cells{ seed };
  seen[seed] = 1;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    if (k % kBreath == 0)
    {
      progress_.check();
    }
    tetrahedra_.prefetch(cells[std::min(k + kAhead, cells.size() - 1)]);
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = tetrahedra_.neighbor(cells[k], facet);
      if (!seen[beyond] && (inside_[beyond] != 0) == side)
      {
        seen[beyond] = 1;
        cells.push_back(beyond);
      }
    }
  }
  return cells;
}

void SolidRepair::removeCrumbsAndVoids()
{
  constexpr std::size_t kCrumb = 100;
  std::vector<std::uint8_t> seen(inside_.size(), 0);
  std::vector<std::vector<std::int32_t>> solids;
  std::vector<std::vector<std::int32_t>> voids;
  for (std::int32_t seed = tetrahedra_.cellCount() - 1; seed >= 0; --seed)
  {
    if (seen[seed])
    {
      continue;
    }
    // Infinite cells come first, so the first outer component is the true outside.
    const bool side = inside_[seed] != 0;
    const bool isVoid = !side && tetrahedra_.finite(seed);
    std::vector<std::int32_t> cells = this->component(seed, seen);
    if (isVoid)
    {
      voids.push_back(std::move(cells));
    }
    else if (side)
    {
      solids.push_back(std::move(cells));
    }
  }
  std::size_t largest = 0;
  for (const auto& cells : solids)
  {
    largest = std::max(largest, cells.size());
  }
  const auto setSides = [this](const std::vector<std::int32_t>& cells, bool inside)
  {
    std::for_each(
      cells.begin(), cells.end(), [&](std::int32_t cell) { this->setSide(cell, inside); });
  };
  for (const auto& cells : voids)
  {
    if (voids_ == Voids::Filled || cells.size() * kCrumb < largest)
    {
      setSides(cells, true);
    }
  }
  for (const auto& cells : solids)
  {
    const bool infinite = this->isHeld(*std::max_element(cells.begin(), cells.end()));
    if (cells.size() * kCrumb < largest && !infinite)
    {
      setSides(cells, false);
    }
  }
}

} // namespace

std::size_t repairSolid(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t>& inside,
  Voids voids, const Progress& progress)
{
  return SolidRepair(tetrahedra, inside, voids, Infinity::Held, progress).run();
}

std::size_t repairSheet(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t>& inside,
  Voids voids, const Progress& progress)
{
  return SolidRepair(tetrahedra, inside, voids, Infinity::Free, progress).run();
}

} // namespace hybridtree
