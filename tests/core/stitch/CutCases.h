// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "tests/support/Random.h"

#include <string>
#include <vector>

namespace hybridtree::test
{

/// A mesh around the origin, and cells to cut it with.
struct CutCase
{
  std::string name;
  TriangleMesh mesh;
  double cellSize;
};

std::vector<CutCase> cutCases();

/// Each cell within reach with this probability, without diagonal contacts.
CellSet randomCells(Random& random, int reach, double share);

CutMesh cutAll(const TriangleMesh& mesh, const CellSet& cells, const CellGrid& grid);

/// Triangles that are neither cut nor gone, rising.
std::vector<std::int32_t> keptTriangles(const TriangleMesh& mesh, const CutMesh& cut);

Vec3 pointOf(const TriangleMesh& mesh, const CutMesh& cut, std::int32_t v);

/// Every side of the pieces has its opposite among the pieces and the kept triangles, or runs
/// against a segment of the border; and those close to loops.
void expectNoCrack(
  const TriangleMesh& mesh, const CutMesh& cut, const CellSet& cells, const std::string& name);

} // namespace hybridtree::test
