// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/LocalPart.h"
#include "core/mesh/MeshLinks.h"

#include <array>
#include <limits>
#include <vector>

namespace hybridtree
{

/// A facet at the cut.
struct FacetPlane
{
  Vec3 normal = Vec3::Zero();
  Box3 box;
  std::array<double, 2> along{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() }; ///< the normal: where its points are
  double tolerance = 0.0;   ///< how far points may be off its plane or line, a length
  std::int32_t source = -1; ///< of its first triangle
  bool hasParts = false;    ///< of several triangles
  bool isFlat = false;
};

/// Takes points out of facets of a mesh that lie inside of one or on the straight border between
/// two, one after the other (Dey et al. 1999), and flips edges within facets to Delaunay. A point
/// or an edge stays where nothing else would do than a triangle without height.
class FacetThinner
{
public:
  using Index = MeshLinks::Index;

  /// \param part triangles of the mesh, on points numbered anew. \param planes of the facets.
  /// \param planeOf per triangle of the part: into planes, -1 for one that may not change.
  FacetThinner(const TriangleMesh& mesh, const LocalPart& part,
    const std::vector<FacetPlane>& planes, const std::vector<std::int32_t>& planeOf)
    : mesh_(mesh)
    , part_(part)
    , planes_(planes)
    , planeOf_(planeOf)
    , links_(part.triangles, part.pointOf.size())
  {
  }

  /// Whether anything has changed.
  bool run();
  const MeshLinks& links() const { return links_; }

  /// Pairs of points of the part: the first has become the second.
  std::vector<std::array<Index, 2>> merged;

private:
  // A point that may go, as its triangles tell.
  struct Around
  {
    std::array<std::int32_t, 2> facet{ -1, -1 }; // one, or two with a straight border
    std::array<Index, 2> along{ MeshLinks::kNone, MeshLinks::kNone }; // edges of the border
    std::size_t count = 0;
  };

  const Vec3& at(Index point) const
  {
    return mesh_.points[std::size_t(part_.pointOf[std::size_t(point)])];
  }
  std::int32_t facetOf(Index h) const { return planeOf_[std::size_t(h / 3)]; }
  const FacetPlane& planeOf(Index h) const { return planes_[std::size_t(this->facetOf(h))]; }
  bool mayChange(std::int32_t facet) const
  {
    return facet >= 0 && planes_[std::size_t(facet)].isFlat;
  }
  bool isWithin(Index h) const
  {
    const Index g = links_.twin(h);
    return g != MeshLinks::kNone && this->facetOf(h) == this->facetOf(g) &&
      this->mayChange(this->facetOf(h));
  }

  double heightOf(const FacetPlane& plane, Index a, Index b, Index c) const;
  double cotangentAt(Index apex, Index a, Index b) const;
  bool mayFlip(Index h) const;
  bool isDelaunay(Index h) const;
  bool lookAround(Index point, Around& around) const;
  bool isStraight(Index point, const Around& around) const;
  bool thinOut(Index point, std::size_t left);
  Index spokeToFlip(Index point) const;
  bool collapseAlong(Index h);
  bool remove(Index point);
  void improve();

  const TriangleMesh& mesh_;
  const LocalPart& part_;
  const std::vector<FacetPlane>& planes_;
  const std::vector<std::int32_t>& planeOf_;
  MeshLinks links_;
  std::vector<char> changed_; // per plane
};

} // namespace hybridtree
