// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/CreaseNotches.h"
#include "core/polygonize/NotchPoints.h"
#include "core/polygonize/TriangleSides.h"

#include <array>
#include <unordered_map>

namespace hybridtree
{

/// The points of a site, as in NotchSite; the last one of a triangle is -1. The first one of a
/// triangle is the lowest, and an edge starts at its lower end, so that each site has one key.
using NotchKey = std::array<std::int32_t, 4>;

NotchKey notchKey(const Triangle& corners);

struct NotchKeyHash
{
  std::size_t operator()(const NotchKey& key) const;
};

/// Where in a mesh notches may be, and what is known of each of these places. The triangles to look
/// at are those with a hot point: of a bent triangle, or of one that was made.
///
/// Each place is looked at once, however often the mesh changes around it.
class NotchSearch
{
public:
  /// All must live as long as this; the mesh may change, see update().
  NotchSearch(const FieldSource& field, const NotchOptions& options, const TriangleMesh& mesh);

  bool hasHotPoints() const { return hasHotPoints_; }
  /// Makes the points of triangles hot that came after those before `firstMade`.
  void heatFrom(std::size_t firstMade);
  /// Finds the triangles and looks at all their edges and, if they are bent, at themselves.
  /// \param removed per triangle of the mesh. \throws Cancelled.
  void update(const std::vector<bool>& removed, const Progress& progress);

  /// Triangles with a hot point,
  const std::vector<std::size_t>& triangles() const { return triangles_; }
  /// and their sides.
  const TriangleSides& sides() const { return sides_; }

  /// The other side of an edge that may be changed, or null; for one of its two sides only.
  /// \param side of sides().
  const TriangleSide* changeableTwin(const TriangleSide& side) const
  {
    return twins_[static_cast<std::size_t>(&side - sides_.all().data())];
  }
  NotchKey edgeKey(const TriangleSide& side, const TriangleSide& twin) const;
  /// That of the edge which would take its place.
  static NotchKey flipped(const NotchKey& key) { return { key[1], key[2], key[3], key[0] }; }
  /// By an edge; not all are known around points at the rim of the region.
  bool mayBeJoined(std::int32_t a, std::int32_t b) const;

  /// Null where nobody looked: triangles that are not bent, and flips of edges without a notch.
  const NotchPoint* find(const NotchKey& key) const;

private:
  bool isBent(const Triangle& corners) const;
  void heat(const Triangle& corners);
  const TriangleSide* findChangeableTwin(const TriangleSide& side) const;
  void findTriangles(const std::vector<bool>& removed);
  void lookAt(const std::vector<NotchKey>& keys, const Progress& progress);
  NotchSite siteOf(const NotchKey& key) const;

  const FieldSource& field_;
  const NotchOptions& options_;
  const TriangleMesh& mesh_;
  bool hasHotPoints_ = false;
  std::vector<bool> hot_; ///< per point
  std::vector<std::size_t> triangles_;
  TriangleSides sides_;
  std::vector<const TriangleSide*> twins_; ///< that may be changed, of each side; or null
  std::unordered_map<NotchKey, NotchPoint, NotchKeyHash> known_;
};

} // namespace hybridtree
