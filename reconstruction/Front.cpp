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
// Empty space is passed at once through facets of at least this size (FacetSize::certainOfFacet).
// Twice a wide membrane would do for speed, but made handles on one in twenty meshes.
constexpr double kEmpty = 12.0;

std::uint8_t bitOf(int facet)
{
  return static_cast<std::uint8_t>(1u << facet);
}

} // namespace

Front::Front(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, const std::vector<Region>& regions)
  : tetrahedra_(tetrahedra)
  , sizes_(sizes)
  , regions_(regions)
  , inside_(tetrahedra.cellCount(), 0)
  , held_(tetrahedra.cellCount(), 0)
  , reached_(tetrahedra.points().size(), 0)
  , edges_(tetrahedra.points().size(), 0)
{
  for (std::int32_t cell = 0; cell < tetrahedra_.cellCount(); ++cell)
  {
    inside_[cell] = tetrahedra_.finite(cell) || regions_[cell] == Region::Inside;
  }
}

void Front::run(bool openPockets, Voids voids, const Progress& progress)
{
  openPockets_ = openPockets;
  this->passEmptySpace(progress);
  this->flow(progress);
  if (voids == Voids::Kept)
  {
    this->openVoids(progress);
  }
}

void Front::flow(const Progress& progress)
{
  for (std::size_t step = 0; !queue_.empty() || !membranes_.empty(); ++step)
  {
    if (step % 8192 == 0)
    {
      progress.check();
      progress.report(double(passed_) / double(tetrahedra_.finiteCellCount()));
    }
    const bool torn = queue_.empty();
    const std::int32_t top = this->nextToPass();
    if (!this->onSurface(top >> 2, top & 3))
    {
      continue;
    }
    if (torn)
    {
      this->tear(top >> 2);
    }
    else if (this->mayPass(top))
    {
      this->pass(top >> 2);
      ++passed_;
    }
  }
}

std::int32_t Front::nextToPass()
{
  if (!queue_.empty())
  {
    this->readAhead();
    return queue_.pop();
  }
  const std::int32_t top = membranes_.top().halfFacet;
  membranes_.pop();
  return top;
}

// Steps are all over the surface: nearly each would wait for memory several times.
void Front::readAhead() const
{
  constexpr std::size_t kCell = 12;
  constexpr std::size_t kAround = 6;
  if (const std::int32_t far = queue_.ahead(kCell); far >= 0)
  {
    tetrahedra_.prefetch(far >> 2);
  }
  if (const std::int32_t near = queue_.ahead(kAround); near >= 0)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      tetrahedra_.prefetch(tetrahedra_.neighbor(near >> 2, facet));
      sizes_.prefetch(tetrahedra_.neighbor(near >> 2, facet));
    }
  }
}

// From the hull through wide facets, without looking at the topology; then uncovers what is left.
void Front::passEmptySpace(const Progress& progress)
{
  std::vector<std::int32_t> passed;
  for (std::int32_t cell = tetrahedra_.finiteCellCount(); cell < tetrahedra_.cellCount(); ++cell)
  {
    if (!this->isInside(cell))
    {
      passed.push_back(cell);
    }
  }
  for (std::size_t k = 0; openPockets_ && k < passed.size(); ++k)
  {
    if (k % 8192 == 0)
    {
      progress.check();
    }
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = tetrahedra_.neighbor(passed[k], facet);
      const int back = tetrahedra_.mirror(passed[k], facet);
      if (this->isInside(beyond) && regions_[beyond] == Region::Outside &&
        sizes_.ofFacet(beyond, back) >= kEmpty && sizes_.certainOfFacet(beyond, back) >= kEmpty)
      {
        inside_[beyond] = 0;
        passed.push_back(beyond);
      }
    }
  }
  for (const std::int32_t cell : passed)
  {
    this->reach(cell);
    this->markEdges(cell, 0);
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
      if (this->isInside(beyond) && (tetrahedra_.finite(cell) || tetrahedra_.finite(beyond)))
      {
        this->uncover(beyond, tetrahedra_.mirror(cell, facet));
      }
    }
  }
}

// In each space that is of the outside and closed off, starts in its largest cell.
void Front::openVoids(const Progress& progress)
{
  std::vector<std::uint8_t> seen(inside_.size(), 0);
  std::vector<std::int32_t> stack;
  for (std::int32_t seed = 0; seed < tetrahedra_.finiteCellCount(); ++seed)
  {
    std::int32_t largest = -1;
    stack.assign(1, seed);
    while (!stack.empty())
    {
      const std::int32_t cell = stack.back();
      stack.pop_back();
      if (seen[cell] || !this->isInside(cell) || regions_[cell] != Region::Outside)
      {
        continue;
      }
      seen[cell] = 1;
      if (this->isBuried(cell) &&
        (largest < 0 || sizes_.lengthOfCell(cell) > sizes_.lengthOfCell(largest)))
      {
        largest = cell;
      }
      for (int facet = 0; facet < 4; ++facet)
      {
        stack.push_back(tetrahedra_.neighbor(cell, facet));
      }
    }
    if (largest >= 0)
    {
      this->pass(largest);
      this->flow(progress);
    }
  }
}

// Whether the surface does not touch a cell.
bool Front::isBuried(std::int32_t cell) const
{
  const auto& vertices = tetrahedra_.cell(cell);
  return std::all_of(vertices.begin(), vertices.end(),
    [this](std::int32_t vertex) { return reached_[vertex] == 0; });
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

bool Front::mayPass(std::int32_t halfFacet)
{
  const std::int32_t cell = halfFacet >> 2;
  if (this->keepsTopology(cell))
  {
    return true;
  }
  held_[cell] |= bitOf(halfFacet & 3);
  // ofFacet is no less, and cheaper.
  if (regions_[cell] == Region::Outside && sizes_.ofFacet(cell, halfFacet & 3) > kMembrane)
  {
    const double size = sizes_.certainOfFacet(cell, halfFacet & 3);
    if (size > kMembrane)
    {
      membranes_.push({ size, halfFacet });
    }
  }
  return false;
}

void Front::pass(std::int32_t cell)
{
  inside_[cell] = 0;
  this->reach(cell);
  unsigned open = 0;
  for (int facet = 0; facet < 4; ++facet)
  {
    const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
    if (this->isInside(beyond))
    {
      this->uncover(beyond, tetrahedra_.mirror(cell, facet));
    }
    else
    {
      open |= bitOf(facet);
    }
  }
  this->markEdges(cell, open);
}

std::uint64_t Front::bitOfEnd(std::int32_t vertex)
{
  return std::uint64_t(1) << (static_cast<std::uint32_t>(vertex) * 0x9e3779b1u >> 26);
}

// Of a cell passed. Those of facets that were open have been marked with the cells beyond.
void Front::markEdges(std::int32_t cell, unsigned open)
{
  const auto& vertices = tetrahedra_.cell(cell);
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      const auto [low, high] = std::minmax(vertices[i], vertices[j]);
      const unsigned beside = static_cast<unsigned>(bitOf(i) | bitOf(j)); // facets without the edge
      if ((open & ~beside) == 0 && low != Tetrahedralization::kInfinite)
      {
        edges_[low] |= bitOfEnd(high);
      }
    }
  }
}

void Front::reach(std::int32_t cell)
{
  for (const std::int32_t vertex : tetrahedra_.cell(cell))
  {
    if (vertex != Tetrahedralization::kInfinite)
    {
      reached_[vertex] = 1;
    }
  }
}

// What was held before its cell is tried again, since the cell has one more open facet now. Nothing
// else could help: a vertex or edge that the front has come to never leaves it but with the cell.
void Front::uncover(std::int32_t cell, int facet)
{
  std::uint8_t tried = held_[cell];
  held_[cell] = 0;
  if (this->mayEverPass(cell, facet))
  {
    tried |= bitOf(facet);
  }
  for (int k = 0; tried >> k != 0; ++k)
  {
    if ((tried & bitOf(k)) != 0)
    {
      queue_.push(sizes_.ofFacet(cell, k), 4 * cell + k);
    }
  }
}

// Sculpting moves that leave the surface a manifold of the same genus: one facet in, onto a vertex
// that is not on the surface; two facets flipped over an edge that is not on it; a spike of three
// facets, or a lone tetrahedron of the outside, removed.
bool Front::keepsTopology(std::int32_t cell) const
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
  if (openCount == 1)
  {
    return reached_[tetrahedra_.cell(cell)[open[0]]] == 0;
  }
  if (openCount == 4)
  {
    return regions_[cell] == Region::Outside;
  }
  return openCount == 3 || (openCount == 2 && this->edgeIsBuried(cell, open[0], open[1]));
}

// Whether no cell around the edge from the i-th vertex to the j-th is passed.
bool Front::edgeIsBuried(std::int32_t cell, int i, int j) const
{
  const std::int32_t from = tetrahedra_.cell(cell)[i];
  const std::int32_t to = tetrahedra_.cell(cell)[j];
  const auto [low, high] = std::minmax(from, to);
  if ((edges_[low] & bitOfEnd(high)) == 0) // nearly always
  {
    return true;
  }
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
