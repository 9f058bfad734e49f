// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Front.h"

#include <algorithm>
#include <tuple>

namespace hybridtree
{

bool Front::HalfFacet::operator<(const HalfFacet& other) const
{
  return std::tie(size, cell, facet) < std::tie(other.size, other.cell, other.facet);
}

Front::Front(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, const std::vector<Region>& regions)
  : tetrahedra_(tetrahedra)
  , sizes_(sizes)
  , regions_(regions)
  , inside_(tetrahedra.cellCount(), 0)
  , surfaceFacets_(tetrahedra.points().size(), 0)
  , held_(tetrahedra.points().size())
{
  std::fill_n(inside_.begin(), tetrahedra.finiteCellCount(), std::uint8_t(1));
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      if (this->onSurface(cell, facet))
      {
        this->uncover(cell, facet);
      }
    }
  }
}

void Front::run(bool openPockets, const Progress& progress)
{
  std::size_t passed = 0;
  for (std::size_t step = 0; !queue_.empty(); ++step)
  {
    if (step % 8192 == 0)
    {
      progress.check();
      progress.report(double(passed) / double(tetrahedra_.finiteCellCount()));
    }
    const HalfFacet top = queue_.top();
    queue_.pop();
    if (this->onSurface(top.cell, top.facet) && this->mayPass(top, openPockets))
    {
      this->pass(top.cell);
      ++passed;
    }
  }
}

bool Front::mayPass(const HalfFacet& at, bool openPockets)
{
  const Region region = regions_[at.cell];
  if (region == Region::Inside)
  {
    return false;
  }
  if (!(region == Region::Outside && openPockets) &&
    tetrahedra_.isOrientedGabriel(at.cell, at.facet))
  {
    return false;
  }
  std::int32_t blocker = 0;
  if (region == Region::Outside || this->keepsTopology(at.cell, blocker))
  {
    return true;
  }
  held_[blocker].push_back(at);
  return false;
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
  queue_.push({ sizes_.ofFacet(cell, facet), cell, facet });
}

void Front::cancel(std::int32_t cell, int facet)
{
  for (const std::int32_t vertex : tetrahedra_.facet(cell, facet))
  {
    --surfaceFacets_[vertex];
    for (const HalfFacet& waiting : held_[vertex])
    {
      queue_.push(waiting);
    }
    held_[vertex].clear();
  }
}

// Sculpting moves that leave the surface a manifold of the same genus: one facet in, onto a vertex
// that is not on the surface; two facets flipped over an edge that is not on it; a spike of three
// facets removed.
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
