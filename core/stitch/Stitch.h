// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"
#include "core/stitch/IslandField.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace hybridtree
{

/// A mesh that stays where no cell is marked.
struct KeptPart
{
  /// Closed, oriented outward, a 2-manifold; with normals.
  MeshPtr mesh;
  /// Added to its sourceLeaf and to the leaf of its vertexOrigin.
  std::int32_t firstLeaf = 0;
  /// Its triangle t is triangle t of a mesh leaf: origins of cut vertices are known.
  bool isLeaf = false;
};

struct StitchOptions
{
  CellGrid grid;
  std::size_t maxBytes = std::size_t(8) << 30;
  /// How often cells around places that do not fit are marked and all is done again.
  int maxRounds = 4;
  /// Whether the surface may have creases, which are looked for in the patches.
  bool haveCreases = true;
  /// Whether small folds in patches are taken out (UnfoldPatch.h). Elsewhere they are told as
  /// faults, and more cells around them are done again: in trees of all kinds what folds is often
  /// thinner than a cell, and lost by less than that.
  bool unfold = false;
};

/// Triangles of a part that stay, one after the other.
struct KeptRun
{
  std::size_t part = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

struct StitchedMesh
{
  TriangleMesh mesh;
  /// Triangles before this are those of the parts: the same points, normals and origins, bit for
  /// bit. The rest is new: what is left of cut triangles, and the patches.
  std::size_t keptTriangles = 0;
  std::vector<KeptRun> keptRuns; ///< which these are, in their order
  std::size_t keptPoints = 0;    ///< points before this are those of the parts
  std::size_t samplePoints = 0;  ///< found on the surface by marching cubes
  std::size_t cutTriangles = 0;  ///< of the parts
  std::size_t islands = 0;       ///< parts of the surface that are made on their own
  std::size_t remembered = 0;    ///< of these, those that had been made before
  int rounds = 1;                ///< more than 1: cells were added
};

/// The surface f = T, from meshes where they are it, and from marching cubes in the marked cells
/// ([HT] 5.2.1).
///
/// Outside of the marked cells the parts' triangles are taken over; those that the border of the
/// marked cells cuts are cut exactly there, and inside the field is polygonized up to that cut.
/// Every island of the marked cells is made and checked on its own (Island.h), and remembered: one
/// of the same cells, parts and dependencies of the field (IslandField.h) is taken as it is. So an
/// edit costs what it changes, and the copy of the rest; the result is the same, bit for bit. Where
/// something is wrong in an island the cells there and around them are marked and it is done again.
///
/// \pre cells is sorted; where no cell is marked f = T on the parts, and nowhere else.
/// \return nothing when it does not come right in options.maxRounds.
/// \throws TooLarge, Cancelled.
std::optional<StitchedMesh> stitch(const IslandField& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress = Progress::none());

/// Of a field that nothing is known of: nothing is remembered, and sourceLeaf is -1 in the patches.
std::optional<StitchedMesh> stitch(const FieldSource& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress = Progress::none());

/// Forgets all islands; for tests and benchmarks.
void forgetIslands();

} // namespace hybridtree
