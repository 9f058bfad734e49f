// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// triangles.push_back({ a, b, c }), for the loops that make most of a mesh: each number is written
/// to its place. A triangle that is put together first is read back, eight bytes at a time, while
/// its parts are still on their way to memory, and the processor waits for them.
inline void addTriangle(
  std::vector<Triangle>& triangles, std::int32_t a, std::int32_t b, std::int32_t c)
{
  Triangle& triangle = triangles.emplace_back();
  triangle[0] = a;
  triangle[1] = b;
  triangle[2] = c;
}

} // namespace hybridtree
