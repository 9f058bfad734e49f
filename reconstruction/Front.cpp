// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Front.h"

#include <algorithm>

namespace hybridtree
{

namespace
{

// A membrane is torn from this size on (FacetSize::certainOfFacet): the sampling's own gaps are
// smaller.
constexpr double kMembrane = 1.75;

} // namespace

Front::Front(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, const std::vector<Region>& regions)
  : tetrahedra_(tetrahedra)
  , sizes_(sizes)
  , regions_(regions)
  , inside_(tetrahedra.cellCount(), 0)
  , surfaceFacets_(tetrahedra.points().size(), 0)
  , firstWaiting_(tetrahedra.points().size(), -1)
{
  std::fill_n(inside_.begin(), tetrahedra.finiteCellCount(), std::uint8_t(1));
}

void Front::run(bool openPockets, const Progress& progress)
{
  openPockets_ = openPockets;
  for (std::int32_t cell = tetrahedra_.finiteCellCount(); cell < tetrahedra_.cellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t hull = tetrahedra_.neighbor(cell, facet);
      if (tetrahedra_.finite(hull))
      {
        this->uncover(hull, tetrahedra_.mirror(cell, facet));
      }
    }
  }
  std::size_t passed = 0;
  for (std::size_t step = 0; !queue_.empty() || !membranes_.empty(); ++step)
  {
    if (step % 8192 == 0)
    {
      progress.check();
      progress.report(double(passed) / double(tetrahedra_.finiteCellCount()));
    }
    const bool torn = queue_.empty();
    auto& queue = torn ? membranes_ : queue_;
    const HalfFacet top = queue.top();
    queue.pop();
    if (!this->onSurface(top.cell, top.facet))
    {
      continue;
    }
    if (torn)
    {
      this->tear(top.cell);
    }
    else if (this->mayPass(top))
    {
      this->pass(top.cell);
      ++passed;
    }
  }
}

// Passes the whole membrane that a cell is of: what is left of the outside around it. Its narrower
// parts would stay as bridges.
void Front::tear(std::int32_t cell)
{
  std::vector<std::int32_t> stack{ cell };
  this->pass(cell);
  while (!stack.empty())
  {
    const std::int32_t from = stack.back();
    stack.pop_back();
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = tetrahedra_.neighbor(from, facet);
      if (this->isInside(beyond) && regions_[beyond] == Region::Outside)
      {
        this->pass(beyond);
        stack.push_back(beyond);
      }
    }
  }
}

// What does not change while the front moves.
bool Front::mayEverPass(std::int32_t cell, int facet) const
{
  const Region region = regions_[cell];
  return region != Region::Inside &&
    ((region == Region::Outside && openPockets_) || !tetrahedra_.isOrientedGabriel(cell, facet));
}

bool Front::mayPass(const HalfFacet& at)
{
  std::int32_t blocker = 0;
  if (this->keepsTopology(at.cell, blocker))
  {
    return true;
  }
  this->hold(at, blocker);
  if (regions_[at.cell] == Region::Outside)
  {
    const double size = sizes_.certainOfFacet(at.cell, at.facet);
    if (size > kMembrane)
    {
      membranes_.push({ size, at.cell, at.facet });
    }
  }
  return false;
}

void Front::hold(const HalfFacet& at, std::int32_t vertex)
{
  if (unused_ < 0)
  {
    unused_ = static_cast<std::int32_t>(waiting_.size());
    waiting_.push_back({ at, -1 });
  }
  const std::int32_t entry = unused_;
  unused_ = waiting_[entry].next;
  waiting_[entry] = { at, firstWaiting_[vertex] };
  firstWaiting_[vertex] = entry;
}

void Front::release(std::int32_t vertex)
{
  while (firstWaiting_[vertex] >= 0)
  {
    const std::int32_t entry = firstWaiting_[vertex];
    firstWaiting_[vertex] = waiting_[entry].next;
    queue_.push(waiting_[entry].at);
    waiting_[entry].next = unused_;
    unused_ = entry;
  }
}

void Front::pass(std::int32_t cell)
{
  inside_[cell] = 0;
  for (int facet = 0; facet < 4; ++facet)
  {
    const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
    if (this->isInside(beyond))
    {
      this->uncover(beyond, tetrahedra_.mirror(cell, facet));
    }
    else
    {
      this->cancel(cell, facet);
    }
  }
}

void Front::uncover(std::int32_t cell, int facet)
{
  for (const std::int32_t vertex : tetrahedra_.facet(cell, facet))
  {
    ++surfaceFacets_[vertex];
  }
  if (this->mayEverPass(cell, facet))
  {
    queue_.push({ sizes_.ofFacet(cell, facet), cell, facet });
  }
}

void Front::cancel(std::int32_t cell, int facet)
{
  for (const std::int32_t vertex : tetrahedra_.facet(cell, facet))
  {
    --surfaceFacets_[vertex];
    this->release(vertex);
  }
}

// Sculpting moves that leave the surface a manifold of the same genus: one facet in, onto a vertex
// that is not on the surface; two facets flipped over an edge that is not on it; a spike of three
// facets, or a lone tetrahedron of the outside, removed.
bool Front::keepsTopology(std::int32_t cell, std::int32_t& blocker) const
{
  int open[4] = { 0, 0, 0, 0 };
  int openCount = 0;
  for (int facet = 0; facet < 4; ++facet)
  {
    if (this->onSurface(cell, facet))
    {
      open[openCount++] = facet;
    }
  }
  blocker = tetrahedra_.cell(cell)[open[0]];
  if (openCount == 1)
  {
    return surfaceFacets_[blocker] == 0;
  }
  if (openCount == 4)
  {
    return regions_[cell] == Region::Outside;
  }
  return openCount == 3 || (openCount == 2 && this->edgeIsBuried(cell, open[0], open[1]));
}

bool Front::edgeIsBuried(std::int32_t cell, int i, int j) const
{
  const std::int32_t from = tetrahedra_.cell(cell)[i];
  const std::int32_t to = tetrahedra_.cell(cell)[j];
  int leave = 0;
  while (leave == i || leave == j)
  {
    ++leave;
  }
  std::int32_t at = cell;
  do
  {
    const int entered = tetrahedra_.mirror(at, leave);
    at = tetrahedra_.neighbor(at, leave);
    if (!this->isInside(at))
    {
      return false;
    }
    // Of the four facets two are around the edge: go on through the other of them.
    leave = 6 - tetrahedra_.indexOf(at, from) - tetrahedra_.indexOf(at, to) - entered;
  } while (at != cell);
  return true;
}

} // namespace hybridtree
