// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

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
};

struct StitchedMesh
{
  TriangleMesh mesh;
  /// Triangles before this are those of the parts: the same points, normals and origins, bit for
  /// bit. The rest is new: what is left of cut triangles, and the patch.
  std::size_t keptTriangles = 0;
  std::size_t keptPoints = 0;   ///< points before this are those of the parts
  std::size_t samplePoints = 0; ///< found on the surface by marching cubes
  std::size_t cutTriangles = 0; ///< of the parts
  int rounds = 1;               ///< more than 1: cells were added
};

/// The surface f = T, from meshes where they are it, and from marching cubes in the marked cells
/// ([HT] 5.2.1).
///
/// Outside of the marked cells the parts' triangles are taken over; those that the border of the
/// marked cells cuts are cut exactly there, and inside the field is polygonized up to that cut
/// (Patch.h). Patch and cut pieces are then given a better shape (PatchShape.h), and all is
/// checked: closed, oriented, 2-manifold, no new triangle turned against the gradient. Where
/// something is wrong, the cells there and around them are marked and all is done again.
///
/// Triangles have sourceLeaf and the rest as far as the parts have it; -1 in the patch, which the
/// caller may fill in.
///
/// \pre cells is sorted; where no cell is marked f = T on the parts, and nowhere else.
/// \return nothing when it does not come right in options.maxRounds.
/// \throws TooLarge, Cancelled.
std::optional<StitchedMesh> stitch(const FieldSource& field, const std::vector<KeptPart>& parts,
  CellSet cells, const StitchOptions& options, const Progress& progress = Progress::none());

} // namespace hybridtree
