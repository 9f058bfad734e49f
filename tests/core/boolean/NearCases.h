// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/support/Random.h"

#include <string>
#include <vector>

namespace hybridtree::test
{

/// Two solids that nearly, or exactly, share faces, edges or points.
struct NearPair
{
  TriangleMesh a;
  TriangleMesh b;
};

/// A way to put a solid near itself or near another one. \pre both are closed, in [-1, 1]^3.
struct NearCase
{
  std::string name;
  NearPair (*make)(Random& random, const TriangleMesh& first, const TriangleMesh& second);
};

/// A solid and itself: turned, shifted or scaled by 1e-16 to 1e-3, slid along one of its faces,
/// turned by a quarter, mirrored, rounded to float. Two solids: face on face, vertex on vertex,
/// vertex on an edge or a face; both very small, very large, or far from the origin.
std::vector<NearCase> nearCases();

/// What a chain of Booleans cuts next: one of the results of a pair (the other way round at times)
/// and one of its operands, as it is or turned, shifted or scaled by 1e-16 to 1e-3. So the operands
/// have faces in common, which rounding has cut differently. Told in `name`.
NearPair nextOfChain(
  Random& random, const NearPair& pair, const BooleanResults& results, std::string& name);

} // namespace hybridtree::test
