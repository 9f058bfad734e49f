// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"
#include "tests/support/Random.h"

#include <string>
#include <vector>

namespace hybridtree::test
{

struct BooleanCase
{
  std::string name;
  TriangleMesh a;
  TriangleMesh b;
  double common; ///< volume of the intersection; negative if not known
};

/// Where general position ends: faces, edges and vertices that coincide or touch, an operand with
/// itself, shifted by one unit in the last place, by an edge, turned by 90 degrees.
std::vector<BooleanCase> hardCases();

TriangleMesh moved(TriangleMesh mesh, const Affine3& map);

/// A rotation, and a shift of at most `reach`.
Affine3 randomPlacement(Random& random, double reach);

/// All three operations of a pair.
struct BooleanResults
{
  MeshBooleanResult unite, intersect, subtract;
};
BooleanResults allOperations(const TriangleMesh& a, const TriangleMesh& b);

double areaOf(const TriangleMesh& mesh);

/// How much more surface union and intersection have than the operands, as a share of that: above 0
/// where something is covered twice, as a hole with a lid is. Surfaces that coincide back to back
/// are lost, which makes it less.
double coveredTwice(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b);

/// The area of triangles that face against the triangle they are a part of: above 0 where one is
/// folded over others. With none, what covers a face covers it as often as its border winds around.
double foldedArea(const MeshBooleanResult& result, const TriangleMesh& a, const TriangleMesh& b);

/// The most that foldedArea() finds in one of the results, as a share of the operands' area.
double foldedShare(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b);

/// Share of the area that may be folded or covered twice: what rounding does.
constexpr double kFolded = 1e-10;

/// What is wrong with the results: not closed and manifold, volumes that do not add up, another
/// volume than `common`, more than `folded` of the area folded or covered twice. Empty if nothing
/// is.
std::string faultsOf(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b,
  double common = -1, double folded = kFolded);

} // namespace hybridtree::test
