// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/MarchingCubesTable.h"

#include <limits>
#include <stdexcept>

namespace hybridtree
{
namespace
{

using Loop = MarchingCubesTable::Loop;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Edge between two neighbouring corners.
unsigned edgeBetween(unsigned a, unsigned b)
{
  for (unsigned edge = 0; edge < 12; ++edge)
  {
    const auto ends = MarchingCubesTable::corners(edge);
    if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))
    {
      return edge;
    }
  }
  throw std::logic_error("These corners of a cell share no edge.");
}

/// Corners of a face, counter-clockwise seen from outside the cell.
std::array<unsigned, 4> faceCorners(unsigned axis, unsigned side)
{
  const unsigned b = 1u << (axis + 1) % 3;
  const unsigned c = 1u << (axis + 2) % 3;
  const unsigned base = side << axis;
  return side == 1 ? std::array<unsigned, 4>{ base, base | b, base | b | c, base | c }
                   : std::array<unsigned, 4>{ base, base | c, base | b | c, base | b };
}

/// next[e]: the edge that follows crossed edge e on its loop. Seen from outside the cell, a segment
/// runs from where the border of the face enters the solid to where it leaves it again, so that the
/// solid is to its left in one cell and, as the neighbour sees the face from behind, in both.
std::array<unsigned, 12> joinEdges(unsigned signs)
{
  std::array<unsigned, 12> next{};
  const auto inside = [signs](unsigned corner) { return (signs >> corner & 1u) != 0; };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    for (unsigned side = 0; side < 2; ++side)
    {
      const auto corner = faceCorners(axis, side);
      for (unsigned k = 0; k < 4; ++k)
      {
        if (inside(corner[k]) || !inside(corner[(k + 1) % 4]))
        {
          continue;
        }
        unsigned last = (k + 1) % 4;
        while (inside(corner[(last + 1) % 4]))
        {
          last = (last + 1) % 4;
        }
        next[edgeBetween(corner[k], corner[(k + 1) % 4])] =
          edgeBetween(corner[last], corner[(last + 1) % 4]);
      }
    }
  }
  return next;
}

double squaredDistance(unsigned edgeA, unsigned edgeB)
{
  double sum = 0.0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const auto middle = [axis](unsigned edge)
    {
      const auto ends = MarchingCubesTable::corners(edge);
      return 0.5 * ((ends[0] >> axis & 1u) + (ends[1] >> axis & 1u));
    };
    const double d = middle(edgeA) - middle(edgeB);
    sum += d * d;
  }
  return sum;
}

double diagonalCost(const Loop& loop, unsigned i, unsigned j)
{
  const bool isSide = j == i + 1 || (i == 0 && j + 1u == loop.size);
  if (isSide)
  {
    return 0.0;
  }
  const unsigned a = loop.edges[i];
  const unsigned b = loop.edges[j];
  const bool inFace = (MarchingCubesTable::facesOf(a) & MarchingCubesTable::facesOf(b)) != 0;
  return inFace ? kNever : squaredDistance(a, b);
}

/// Optimal triangulation of a polygon (Klincsek 1980): shortest diagonals for vertices on the
/// middles of the edges, none of them in a face.
class LoopFiller
{
public:
  explicit LoopFiller(Loop& loop) : loop_(loop) {}

  double fill()
  {
    const unsigned n = loop_.size;
    for (unsigned length = 2; length < n; ++length)
    {
      for (unsigned i = 0; i + length < n; ++i)
      {
        this->solve(i, i + length);
      }
    }
    this->collect(0, n - 1);
    return cost_[0][n - 1];
  }

private:
  void solve(unsigned i, unsigned j)
  {
    cost_[i][j] = kNever;
    split_[i][j] = i + 1;
    for (unsigned k = i + 1; k < j; ++k)
    {
      const double cost = cost_[i][k] + cost_[k][j] + diagonalCost(loop_, i, j);
      if (cost < cost_[i][j])
      {
        cost_[i][j] = cost;
        split_[i][j] = k;
      }
    }
  }

  void collect(unsigned i, unsigned j)
  {
    if (j < i + 2)
    {
      return;
    }
    const unsigned k = split_[i][j];
    for (const unsigned corner : { i, k, j })
    {
      loop_.triangles[count_++] = static_cast<std::uint8_t>(corner);
    }
    this->collect(i, k);
    this->collect(k, j);
  }

  Loop& loop_;
  double cost_[7][7] = {};
  unsigned split_[7][7] = {};
  unsigned count_ = 0;
};

Loop traceLoop(const std::array<unsigned, 12>& next, unsigned first)
{
  Loop loop;
  unsigned edge = first;
  do
  {
    loop.edges.at(loop.size++) = static_cast<std::uint8_t>(edge);
    edge = next[edge];
  } while (edge != first);
  if (!(LoopFiller(loop).fill() < kNever))
  {
    throw std::logic_error("A loop of a marching cubes cell needs a diagonal in a face.");
  }
  return loop;
}

MarchingCubesTable::Case makeCase(unsigned signs)
{
  MarchingCubesTable::Case result;
  for (unsigned edge = 0; edge < 12; ++edge)
  {
    const auto ends = MarchingCubesTable::corners(edge);
    const bool crossed = (signs >> ends[0] & 1u) != (signs >> ends[1] & 1u);
    result.edgeMask = static_cast<std::uint16_t>(result.edgeMask | unsigned(crossed) << edge);
  }
  const auto next = joinEdges(signs);
  unsigned left = result.edgeMask;
  for (unsigned edge = 0; edge < 12; ++edge)
  {
    if ((left >> edge & 1u) == 0)
    {
      continue;
    }
    const Loop loop = traceLoop(next, edge);
    for (unsigned k = 0; k < loop.size; ++k)
    {
      left &= ~(1u << loop.edges[k]);
    }
    result.loops[result.loopCount++] = loop;
    result.triangleCount = static_cast<std::uint8_t>(result.triangleCount + loop.size - 2);
  }
  return result;
}

} // namespace

unsigned MarchingCubesTable::facesOf(unsigned edge)
{
  const auto ends = corners(edge);
  unsigned faces = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const unsigned side = ends[0] >> axis & 1u;
    if (side == (ends[1] >> axis & 1u))
    {
      faces |= 1u << (2 * axis + side);
    }
  }
  return faces;
}

MarchingCubesTable::MarchingCubesTable()
{
  for (unsigned signs = 0; signs < 256; ++signs)
  {
    cases_[signs] = makeCase(signs);
  }
}

const MarchingCubesTable& MarchingCubesTable::instance()
{
  static const MarchingCubesTable table;
  return table;
}

} // namespace hybridtree
