// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/MarchingCubesTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

using Case = MarchingCubesTable::Case;
using Loop = MarchingCubesTable::Loop;
using Segment = std::pair<unsigned, unsigned>;

/// Directed sides of the loops that lie in a face: bit 2 axis + side of
/// MarchingCubesTable::facesOf.
std::set<Segment> segmentsIn(const Case& cell, unsigned face)
{
  std::set<Segment> segments;
  for (unsigned n = 0; n < cell.loopCount; ++n)
  {
    const Loop& loop = cell.loops[n];
    for (unsigned k = 0; k < loop.size; ++k)
    {
      const unsigned a = loop.edges[k];
      const unsigned b = loop.edges[(k + 1) % loop.size];
      if ((MarchingCubesTable::facesOf(a) & MarchingCubesTable::facesOf(b) & 1u << face) != 0)
      {
        segments.insert({ a, b });
      }
    }
  }
  return segments;
}

bool signAt(unsigned signs, unsigned corner)
{
  return (signs >> corner & 1u) != 0;
}

TEST(MarchingCubesTable, LoopsPassEveryCrossedEdgeOnce)
{
  for (unsigned signs = 0; signs < 256; ++signs)
  {
    const Case& cell = MarchingCubesTable::instance()[signs];
    std::multiset<unsigned> passed;
    for (unsigned n = 0; n < cell.loopCount; ++n)
    {
      const Loop& loop = cell.loops[n];
      passed.insert(loop.edges.begin(), loop.edges.begin() + loop.size);
    }
    for (unsigned edge = 0; edge < 12; ++edge)
    {
      const auto ends = MarchingCubesTable::corners(edge);
      const bool crossed = signAt(signs, ends[0]) != signAt(signs, ends[1]);
      EXPECT_EQ(passed.count(edge), crossed ? 1u : 0u) << "edge " << edge << " of case " << signs;
      EXPECT_EQ((cell.edgeMask >> edge & 1u) != 0, crossed);
    }
  }
}

// Two cells that share a face see the same segments on it, in opposite directions: all 2^12
// pairs for each axis.
TEST(MarchingCubesTable, NeighboursAgreeOnTheirFace)
{
  const MarchingCubesTable& table = MarchingCubesTable::instance();
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const auto otherSide = [axis](unsigned edge)
    {
      // The edge of the upper cell at the place of `edge` on the upper face of the lower cell.
      for (unsigned other = 0; other < 12; ++other)
      {
        if (other / 4 == edge / 4 &&
          (MarchingCubesTable::corners(other)[0] | 1u << axis) ==
            MarchingCubesTable::corners(edge)[0])
        {
          return other;
        }
      }
      return 12u;
    };
    for (unsigned low = 0; low < 256; ++low)
    {
      for (unsigned high = 0; high < 256; ++high)
      {
        bool fits = true;
        for (unsigned corner = 0; corner < 8; ++corner)
        {
          fits = fits &&
            ((corner >> axis & 1u) != 0 ||
              signAt(high, corner) == signAt(low, corner | 1u << axis));
        }
        if (!fits)
        {
          continue;
        }
        std::set<Segment> expected;
        for (const auto& [a, b] : segmentsIn(table[low], 2 * axis + 1))
        {
          expected.insert({ otherSide(b), otherSide(a) });
        }
        ASSERT_EQ(segmentsIn(table[high], 2 * axis), expected) << low << " below " << high;
      }
    }
  }
}

TEST(MarchingCubesTable, TrianglesFillTheirLoopWithoutDiagonalsInFaces)
{
  for (unsigned signs = 0; signs < 256; ++signs)
  {
    const Case& cell = MarchingCubesTable::instance()[signs];
    unsigned triangles = 0;
    for (unsigned n = 0; n < cell.loopCount; ++n)
    {
      const Loop& loop = cell.loops[n];
      std::map<Segment, int> sides; // directed, by position
      for (unsigned t = 0; t < 3u * (loop.size - 2u); t += 3)
      {
        for (unsigned k = 0; k < 3; ++k)
        {
          ++sides[{ loop.triangles[t + k], loop.triangles[t + (k + 1) % 3] }];
        }
      }
      for (unsigned k = 0; k < loop.size; ++k)
      {
        EXPECT_EQ(sides[Segment(k, (k + 1) % loop.size)], 1) << "case " << signs;
        sides.erase(Segment(k, (k + 1u) % loop.size));
      }
      for (const auto& [side, count] : sides)
      {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(sides.count({ side.second, side.first }), 1u) << "case " << signs;
        EXPECT_EQ(MarchingCubesTable::facesOf(loop.edges[side.first]) &
            MarchingCubesTable::facesOf(loop.edges[side.second]),
          0u)
          << "diagonal in a face, case " << signs;
      }
      if (loop.size == 4)
      {
        for (unsigned k = 0; k < 2; ++k)
        {
          EXPECT_EQ(MarchingCubesTable::facesOf(loop.edges[k]) &
              MarchingCubesTable::facesOf(loop.edges[k + 2]),
            0u);
        }
      }
      triangles += loop.size - 2u;
    }
    EXPECT_EQ(triangles, cell.triangleCount);
  }
}

// Inside corners across the diagonal of a face are parted: so of an ambiguous face each inside
// corner is cut off by itself.
TEST(MarchingCubesTable, AmbiguousFacesPartTheInsideCorners)
{
  const unsigned signs = 1u << 0 | 1u << 3; // (0,0,0) and (1,1,0)
  const std::set<Segment> segments = segmentsIn(MarchingCubesTable::instance()[signs], 4);
  ASSERT_EQ(segments.size(), 2u);
  for (const auto& [a, b] : segments)
  {
    const auto endsA = MarchingCubesTable::corners(a);
    const auto endsB = MarchingCubesTable::corners(b);
    const bool shareInside = std::any_of(endsA.begin(), endsA.end(),
      [&](unsigned corner)
      { return signAt(signs, corner) && (corner == endsB[0] || corner == endsB[1]); });
    EXPECT_TRUE(shareInside);
  }
}

} // namespace
} // namespace hybridtree
