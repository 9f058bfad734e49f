// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/LooseTriangles.h"

#include "core/base/DisjointSets.h"
#include "core/mesh/HalfEdges.h"

#include <cstddef>
#include <cstdint>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMostInAPiece = 12;
constexpr std::size_t kOneOf = 100;

struct Piece
{
  std::size_t triangles = 0;
  bool open = false;
  bool joined = false; // to others, by an edge of more than two triangles
};

} // namespace

std::vector<bool> looseTriangles(const std::vector<Triangle>& triangles)
{
  const HalfEdges edges = halfEdges(triangles);
  DisjointSets sets(triangles.size());
  for (std::size_t half = 0; half < edges.opposite.size(); ++half)
  {
    if (edges.opposite[half] >= 0)
    {
      sets.join(std::uint32_t(half / 3), std::uint32_t(edges.opposite[half] / 3));
    }
  }
  std::vector<Piece> pieces(triangles.size());
  for (std::size_t half = 0; half < edges.opposite.size(); ++half)
  {
    Piece& piece = pieces[sets.find(std::uint32_t(half / 3))];
    piece.triangles += half % 3 == 0;
    piece.open = piece.open || edges.opposite[half] == HalfEdges::kOpen;
    piece.joined = piece.joined || edges.opposite[half] == HalfEdges::kNonManifold;
  }
  std::vector<bool> loose(triangles.size(), false);
  std::size_t count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Piece& piece = pieces[sets.find(std::uint32_t(t))];
    if (!piece.open)
    {
      continue;
    }
    if (piece.joined || piece.triangles > kMostInAPiece)
    {
      return {};
    }
    loose[t] = true;
    ++count;
  }
  return count > 0 && count * kOneOf <= triangles.size() ? loose : std::vector<bool>();
}

} // namespace hybridtree
