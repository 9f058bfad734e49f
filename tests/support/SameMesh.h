// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace hybridtree::test
{

/// Bit for bit, with all that is told of points and triangles.
inline void expectSame(const TriangleMesh& a, const TriangleMesh& b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.sourceLeaf, b.sourceLeaf);
  EXPECT_EQ(a.sourceTriangle, b.sourceTriangle);
  ASSERT_EQ(a.vertexOrigin.size(), b.vertexOrigin.size());
  for (std::size_t v = 0; v < a.vertexOrigin.size(); ++v)
  {
    const VertexOrigin& first = a.vertexOrigin[v];
    const VertexOrigin& second = b.vertexOrigin[v];
    ASSERT_TRUE(first.leaf == second.leaf && first.triangle == second.triangle &&
      first.u == second.u && first.v == second.v)
      << v;
  }
}

} // namespace hybridtree::test
