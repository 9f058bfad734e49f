// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SmallHandles.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

namespace hybridtree
{
namespace
{

using Cells = std::vector<std::int32_t>;  // or vertices
using Edge = std::array<std::int32_t, 3>; // two vertices, the lesser first, and a cell at it

class HandleRemoval
{
public:
  HandleRemoval(const Tetrahedralization& tetrahedra, const FacetSize& sizes, double small,
    std::vector<std::uint8_t>& inside)
    : tetrahedra_(tetrahedra)
    , sizes_(sizes)
    , small_(small)
    , inside_(inside)
    , mark_(inside.size(), 0)
  {
  }

  std::size_t run(const Progress& progress)
  {
    Cells vertices(tetrahedra_.points().size());
    std::iota(vertices.begin(), vertices.end(), 0);
    std::size_t removed = 0;
    for (std::size_t more = 1; more > 0; removed += more) // one handle may hide another
    {
      more = this->sweep(vertices, progress);
    }
    return removed;
  }

private:
  std::size_t sweep(Cells& vertices, const Progress& progress);
  bool isKnotted(std::int32_t vertex);
  bool tryFlip(std::int32_t vertex, bool side);
  int clumpsAround(std::int32_t vertex);
  bool isManifoldAround(const std::vector<std::int32_t>& vertices);
  std::size_t partsOn(bool side);
  long flip(const Cells& cells);
  long gainOfJoining(const Cells& cells);
  bool touchesSolid(std::int32_t vertex) const;
  bool touchesSolid(const Edge& edge) const;
  std::vector<std::int32_t> verticesOf(const Cells& cells) const;

  template <typename Side>
  int countClumps(std::int32_t vertex, const Side& side);

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  double small_;
  std::vector<std::uint8_t>& inside_;
  std::vector<std::uint8_t> mark_; // all 0 between uses
};

// Leaves the vertices worth another try.
std::size_t HandleRemoval::sweep(Cells& vertices, const Progress& progress)
{
  std::size_t removed = 0;
  Cells left;
  for (std::size_t k = 0; k < vertices.size(); ++k)
  {
    if (k % 1024 == 0)
    {
      progress.check();
    }
    if (!this->isKnotted(vertices[k]))
    {
      continue;
    }
    if (this->tryFlip(vertices[k], false) || this->tryFlip(vertices[k], true))
    {
      ++removed;
    }
    else
    {
      left.push_back(vertices[k]);
    }
  }
  vertices = std::move(left);
  return removed;
}

// Groups of cells around a vertex that are on the same side and hang together by facets.
template <typename Side>
int HandleRemoval::countClumps(std::int32_t vertex, const Side& side)
{
  const auto star = tetrahedra_.star(vertex);
  std::for_each(star.begin(), star.end(), [this](std::int32_t cell) { mark_[cell] = 1; });
  int clumps = 0;
  Cells stack;
  for (const std::int32_t seed : star)
  {
    if (!mark_[seed])
    {
      continue;
    }
    ++clumps;
    mark_[seed] = 0;
    stack.assign(1, seed);
    while (!stack.empty())
    {
      const std::int32_t cell = stack.back();
      stack.pop_back();
      for (int facet = 0; facet < 4; ++facet)
      {
        const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
        if (mark_[beyond] && side(beyond) == side(cell))
        {
          mark_[beyond] = 0;
          stack.push_back(beyond);
        }
      }
    }
  }
  return clumps;
}

int HandleRemoval::clumpsAround(std::int32_t vertex)
{
  return this->countClumps(vertex, [this](std::int32_t cell) { return inside_[cell]; });
}

// Whether the solid meets the hull of the cells around a vertex of its surface in more than one
// disc: only then does the topology change when they all go to one side.
bool HandleRemoval::isKnotted(std::int32_t vertex)
{
  if (this->clumpsAround(vertex) < 2)
  {
    return false;
  }
  return this->countClumps(vertex,
           [&](std::int32_t cell)
           { return inside_[tetrahedra_.neighbor(cell, tetrahedra_.indexOf(cell, vertex))]; }) > 2;
}

std::vector<std::int32_t> HandleRemoval::verticesOf(const Cells& cells) const
{
  std::vector<std::int32_t> vertices;
  for (const std::int32_t cell : cells)
  {
    const auto& v = tetrahedra_.cell(cell);
    std::copy_if(v.begin(), v.end(), std::back_inserter(vertices),
      [](std::int32_t vertex) { return vertex != Tetrahedralization::kInfinite; });
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

bool HandleRemoval::touchesSolid(std::int32_t vertex) const
{
  const auto star = tetrahedra_.star(vertex);
  return std::any_of(
    star.begin(), star.end(), [this](std::int32_t cell) { return inside_[cell] != 0; });
}

bool HandleRemoval::touchesSolid(const Edge& edge) const
{
  const auto [from, to, cell] = edge;
  int leave = 0;
  while (tetrahedra_.cell(cell)[leave] == from || tetrahedra_.cell(cell)[leave] == to)
  {
    ++leave;
  }
  std::int32_t at = cell;
  do
  {
    if (inside_[at])
    {
      return true;
    }
    const int entered = tetrahedra_.mirror(at, leave);
    at = tetrahedra_.neighbor(at, leave);
    // Of the four facets two are around the edge: go on through the other of them.
    leave = 6 - tetrahedra_.indexOf(at, from) - tetrahedra_.indexOf(at, to) - entered;
  } while (at != cell);
  return false;
}

// What the Euler characteristic of the solid gains when the cells join it: that of their simplices
// which it has not yet. \pre the cells are not inside.
long HandleRemoval::gainOfJoining(const Cells& cells)
{
  long gain = 0;
  std::vector<Edge> edges;
  for (const std::int32_t cell : cells)
  {
    --gain;
    mark_[cell] = 1; // its facets are counted
    const auto& v = tetrahedra_.cell(cell);
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t beyond = tetrahedra_.neighbor(cell, i);
      gain += !inside_[beyond] && !mark_[beyond];
      for (int j = 0; j < i; ++j)
      {
        edges.push_back({ std::min(v[i], v[j]), std::max(v[i], v[j]), cell });
      }
    }
  }
  std::for_each(cells.begin(), cells.end(), [this](std::int32_t cell) { mark_[cell] = 0; });
  std::sort(edges.begin(), edges.end());
  const auto same = [](const Edge& a, const Edge& b) { return a[0] == b[0] && a[1] == b[1]; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  gain -= std::count_if(
    edges.begin(), edges.end(), [this](const Edge& edge) { return !this->touchesSolid(edge); });
  const std::vector<std::int32_t> vertices = this->verticesOf(cells);
  return gain +
    std::count_if(vertices.begin(), vertices.end(),
      [this](std::int32_t vertex) { return !this->touchesSolid(vertex); });
}

// The cells change sides. \returns what the Euler characteristic of the solid gains.
long HandleRemoval::flip(const Cells& cells)
{
  const auto turn = [this](std::int32_t cell) { inside_[cell] ^= 1; };
  if (inside_[cells.front()])
  {
    std::for_each(cells.begin(), cells.end(), turn);
    return -this->gainOfJoining(cells);
  }
  const long gain = this->gainOfJoining(cells);
  std::for_each(cells.begin(), cells.end(), turn);
  return gain;
}

bool HandleRemoval::isManifoldAround(const std::vector<std::int32_t>& vertices)
{
  return std::all_of(vertices.begin(), vertices.end(),
    [this](std::int32_t vertex) { return this->clumpsAround(vertex) <= 2; });
}

// How many parts the solid or its complement is in.
std::size_t HandleRemoval::partsOn(bool side)
{
  std::vector<std::uint8_t> seen(inside_.size(), 0);
  std::size_t parts = 0;
  Cells stack;
  for (std::int32_t seed = 0; seed < tetrahedra_.cellCount(); ++seed)
  {
    if (seen[seed] || (inside_[seed] != 0) != side)
    {
      continue;
    }
    ++parts;
    seen[seed] = 1;
    stack.assign(1, seed);
    while (!stack.empty())
    {
      const std::int32_t cell = stack.back();
      stack.pop_back();
      for (int facet = 0; facet < 4; ++facet)
      {
        const std::int32_t beyond = tetrahedra_.neighbor(cell, facet);
        if (!seen[beyond] && (inside_[beyond] != 0) == side)
        {
          seen[beyond] = 1;
          stack.push_back(beyond);
        }
      }
    }
  }
  return parts;
}

// Moves the small cells of a side around a vertex to the other, if this removes a handle.
bool HandleRemoval::tryFlip(std::int32_t vertex, bool side)
{
  const auto star = tetrahedra_.star(vertex);
  Cells cells;
  std::copy_if(star.begin(), star.end(), std::back_inserter(cells),
    [&](std::int32_t cell)
    {
      return tetrahedra_.finite(cell) && (inside_[cell] != 0) == side &&
        sizes_.ofCell(cell) <= small_;
    });
  if (cells.empty())
  {
    return false;
  }
  const std::vector<std::int32_t> vertices = this->verticesOf(cells);
  if (this->flip(cells) > 0 && this->isManifoldAround(vertices))
  {
    const std::size_t partsAfter = this->partsOn(side);
    this->flip(cells);
    if (partsAfter > this->partsOn(side)) // the gain is a part or a void, not a handle less
    {
      return false;
    }
    this->flip(cells);
    return true;
  }
  this->flip(cells);
  return false;
}

} // namespace

std::size_t removeSmallHandles(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double small, std::vector<std::uint8_t>& inside, const Progress& progress)
{
  return HandleRemoval(tetrahedra, sizes, small, inside).run(progress);
}

} // namespace hybridtree
