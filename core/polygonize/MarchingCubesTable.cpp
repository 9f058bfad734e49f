// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/MarchingCubesTable.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace hybridtree
{
namespace
{

constexpr unsigned kMostEdges = 12;
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

/// Of four corners around a face two across a diagonal are inside and the others are not.
bool isAmbiguous(unsigned signs, const std::array<unsigned, 4>& corner)
{
  const auto side = [&](unsigned k) { return signs >> corner[k] & 1u; };
  return side(0) == side(2) && side(1) == side(3) && side(0) != side(1);
}

unsigned ambiguousFaces(unsigned signs)
{
  unsigned faces = 0;
  for (unsigned face = 0; face < 6; ++face)
  {
    faces |= unsigned(isAmbiguous(signs, faceCorners(face / 2, face & 1u))) << face;
  }
  return faces;
}

/// next[e]: the edge that follows crossed edge e on its loop. Seen from outside the cell, a segment
/// runs from where the border of the face enters the solid to where it leaves it again, so that the
/// solid is to its left in one cell and, as the neighbour sees the face from behind, in both. Where
/// inside corners are joined it runs to where the border has left the solid before.
std::array<unsigned, 12> joinEdges(unsigned signs, unsigned joinedFaces)
{
  std::array<unsigned, 12> next{};
  const auto inside = [signs](unsigned corner) { return (signs >> corner & 1u) != 0; };
  for (unsigned face = 0; face < 6; ++face)
  {
    const auto corner = faceCorners(face / 2, face & 1u);
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
      last = (joinedFaces >> face & 1u) != 0 ? (k + 3) % 4 : last;
      next[edgeBetween(corner[k], corner[(k + 1) % 4])] =
        edgeBetween(corner[last], corner[(last + 1) % 4]);
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

/// Crossed edges in cyclic order.
using Polygon = std::vector<std::uint8_t>;

double diagonalCost(const Polygon& edges, unsigned i, unsigned j)
{
  const bool isSide = j == i + 1 || (i == 0 && j + 1u == edges.size());
  if (isSide)
  {
    return 0.0;
  }
  const unsigned a = edges[i];
  const unsigned b = edges[j];
  const bool inFace = (MarchingCubesTable::facesOf(a) & MarchingCubesTable::facesOf(b)) != 0;
  return inFace ? kNever : squaredDistance(a, b);
}

/// Optimal triangulation of a polygon (Klincsek 1980): shortest diagonals for vertices on the
/// middles of the edges, none of them in a face.
class LoopFiller
{
public:
  explicit LoopFiller(const Polygon& edges) : edges_(edges) {}

  /// Positions in the polygon; empty where some diagonal would lie in a face.
  Polygon fill()
  {
    const auto n = static_cast<unsigned>(edges_.size());
    for (unsigned length = 2; length < n; ++length)
    {
      for (unsigned i = 0; i + length < n; ++i)
      {
        this->solve(i, i + length);
      }
    }
    if (cost_[0][n - 1] < kNever)
    {
      this->collect(0, n - 1);
    }
    return std::move(triangles_);
  }

private:
  void solve(unsigned i, unsigned j)
  {
    cost_[i][j] = kNever;
    split_[i][j] = i + 1;
    for (unsigned k = i + 1; k < j; ++k)
    {
      const double cost = cost_[i][k] + cost_[k][j] + diagonalCost(edges_, i, j);
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
      triangles_.push_back(static_cast<std::uint8_t>(corner));
    }
    this->collect(i, k);
    this->collect(k, j);
  }

  const Polygon& edges_;
  Polygon triangles_;
  double cost_[kMostEdges][kMostEdges] = {};
  unsigned split_[kMostEdges][kMostEdges] = {};
};

unsigned crossedEdges(unsigned signs)
{
  unsigned mask = 0;
  for (unsigned edge = 0; edge < 12; ++edge)
  {
    const auto ends = MarchingCubesTable::corners(edge);
    mask |= unsigned((signs >> ends[0] & 1u) != (signs >> ends[1] & 1u)) << edge;
  }
  return mask;
}

std::vector<Polygon> traceLoops(unsigned signs, unsigned joinedFaces)
{
  const auto next = joinEdges(signs, joinedFaces);
  std::vector<Polygon> loops;
  unsigned left = crossedEdges(signs);
  for (unsigned first = 0; first < 12; ++first)
  {
    if ((left >> first & 1u) == 0)
    {
      continue;
    }
    loops.emplace_back();
    unsigned edge = first;
    do
    {
      loops.back().push_back(static_cast<std::uint8_t>(edge));
      left &= ~(1u << edge);
      edge = next[edge];
    } while (edge != first);
  }
  return loops;
}

MarchingCubesTable::Case makeCase(unsigned signs)
{
  MarchingCubesTable::Case result;
  result.edgeMask = static_cast<std::uint16_t>(crossedEdges(signs));
  result.ambiguous = static_cast<std::uint8_t>(ambiguousFaces(signs));
  for (const Polygon& edges : traceLoops(signs, 0))
  {
    const Polygon triangles = LoopFiller(edges).fill();
    MarchingCubesTable::Loop& loop = result.loops.at(result.loopCount++);
    if (triangles.empty() || edges.size() > loop.edges.size())
    {
      throw std::logic_error("A loop of a marching cubes cell needs a diagonal in a face.");
    }
    loop.size = static_cast<std::uint8_t>(edges.size());
    std::copy(edges.begin(), edges.end(), loop.edges.begin());
    std::copy(triangles.begin(), triangles.end(), loop.triangles.begin());
    result.triangleCount = static_cast<std::uint8_t>(result.triangleCount + triangles.size() / 3);
  }
  return result;
}

std::vector<MarchingCubesTable::JoinedLoop> makeJoined(unsigned signs, unsigned faces)
{
  std::vector<MarchingCubesTable::JoinedLoop> loops;
  for (const Polygon& edges : traceLoops(signs, faces))
  {
    loops.push_back({ edges, LoopFiller(edges).fill() });
  }
  return loops;
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
    const unsigned ambiguous = cases_[signs].ambiguous;
    for (unsigned faces = ambiguous; faces != 0; faces = (faces - 1) & ambiguous)
    {
      joined_[signs << 6 | faces] = makeJoined(signs, faces);
    }
  }
}

const MarchingCubesTable& MarchingCubesTable::instance()
{
  static const MarchingCubesTable table;
  return table;
}

} // namespace hybridtree
