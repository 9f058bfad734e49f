// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/subdivision/PieceMesh.h"

#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace hybridtree
{

/// A skeleton, the field around it, and how far that reaches.
struct SkeletonField
{
  const SkeletonGraph& coarse;
  const RefinedSkeleton& refined; ///< of coarse, level times
  int level = 0;
  const FieldSource& field;
  /// An element is felt up to this many times its largest radius away from it.
  double influenceRatio = 2.0;
  /// Other numbers that the field depends on (kernel, blending, ...), in one. Fields with equal
  /// elements and equal keys must be equal.
  std::uint64_t key = 0;
  /// What the meshes of pieces follow near single elements; null: `field` everywhere.
  const ElementFields* elements = nullptr;
  /// No creases anywhere, as where everything blends.
  bool isSmooth = false;
};

using PieceMeshPtr = std::shared_ptr<const PieceMesh>;

/// Meshes of the pieces that were asked for last, by all that they depend on: of a skeleton of
/// which one point is moved, those out of its reach are found here, and the others begin where
/// their axes were. Any number of threads may ask.
class PieceMeshCache
{
public:
  explicit PieceMeshCache(std::size_t maxBytes = std::size_t(256) << 20) : maxBytes_(maxBytes) {}

  PieceMeshPtr find(std::uint64_t key);
  void insert(std::uint64_t key, const PieceMeshPtr& mesh);
  /// The mesh that a piece of this number had last; null where there is none.
  PieceMeshPtr last(std::size_t piece) const;
  void setLast(std::size_t piece, const PieceMeshPtr& mesh);
  /// Answers of find() that were not null, since the beginning.
  std::size_t hits() const;

private:
  using Entry = std::pair<std::uint64_t, PieceMeshPtr>;

  mutable std::mutex mutex_;
  std::size_t maxBytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_; // last used first
  std::unordered_map<std::uint64_t, std::list<Entry>::iterator> places_;
  std::unordered_map<std::size_t, std::weak_ptr<const PieceMesh>> last_;
  std::size_t hits_ = 0;
};

/// The meshes of all pieces, in the order of findPieces(); some may be empty. Together they cover
/// the surface, and overlap where pieces meet ([SUB] 4). \param cache null for none. The result is
/// the same but for where in its tolerance each vertex lies.
std::vector<PieceMeshPtr> pieceMeshes(const SkeletonField& skeleton,
  const PieceMeshOptions& options, PieceMeshCache* cache = nullptr,
  const Progress& progress = Progress::none());

/// All of them in one, for a quick look: closed surfaces that overlap.
/// sourceLeaf is the number of the piece.
TriangleMesh joinPieces(const std::vector<PieceMeshPtr>& pieces);

} // namespace hybridtree
