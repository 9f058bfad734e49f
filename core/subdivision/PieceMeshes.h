// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/base/Dependency.h"
#include "core/base/Progress.h"
#include "core/subdivision/LocalField.h"
#include "core/subdivision/PieceMesh.h"

#include <memory>
#include <vector>

namespace hybridtree
{

/// A skeleton, the field around it, and how far that reaches.
struct SkeletonField
{
  const SkeletonGraph& coarse;
  const RefinedSkeleton& refined; ///< of coarse, level times
  int level = 0;
  const FieldSource& field;
  /// What the meshes of pieces follow near single elements; null: `field` everywhere.
  const ElementFields* elements = nullptr;
  /// No creases anywhere, as where everything blends.
  bool isSmooth = false;
  /// `field`, and with it `elements`, by what they depend on; null: nothing is remembered.
  const LocalField* local = nullptr;
};

using PieceMeshPtr = std::shared_ptr<const PieceMesh>;

/// All that the mesh of a piece depends on.
struct PieceKey
{
  Contents own; ///< what it is, and the options
  std::vector<Dependency> field;

  std::uint64_t hash() const;
  bool operator==(const PieceKey& other) const { return field == other.field && own == other.own; }
  bool isExpired() const { return anyExpired(field); }
};

/// Meshes of pieces, so that of a skeleton of which one point is moved those out of its reach are
/// found.
class PieceMeshCache : public RecentStore<PieceKey, PieceMesh>
{
public:
  explicit PieceMeshCache(std::size_t maxBytes = std::size_t(256) << 20) : RecentStore(maxBytes) {}
};

/// The meshes of all pieces, in the order of findPieces(); some may be empty. Together they cover
/// the surface, and overlap where pieces meet ([SUB] 4). \param cache null for none: the result is
/// the same, bit for bit.
std::vector<PieceMeshPtr> pieceMeshes(const SkeletonField& skeleton,
  const PieceMeshOptions& options, PieceMeshCache* cache = nullptr,
  const Progress& progress = Progress::none());

/// All of them in one, for a quick look: closed surfaces that overlap.
/// sourceLeaf is the number of the piece.
TriangleMesh joinPieces(const std::vector<PieceMeshPtr>& pieces);

} // namespace hybridtree
