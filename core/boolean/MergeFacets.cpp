// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MergeFacets.h"

#include "core/boolean/CompactResult.h"
#include "core/boolean/FacetThinner.h"
#include "core/boolean/LocalPart.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

// How far points of a facet may be off its plane or line: of the largest coordinate, what rounding
// does; of the facet, what is left where points were moved along it.
constexpr double kRounding = 0x1p-42;
constexpr double kOffPlane = 0x1p-26;

class Merger
{
public:
  using Index = MeshLinks::Index;

  Merger(MeshBooleanResult& result, const Facets& facets)
    : result_(result), mesh_(result.mesh), facets_(facets), planeOf_(std::size_t(facets.count), -1)
  {
  }

  void run()
  {
    this->findPlanes();
    if (!this->measurePlanes())
    {
      return;
    }
    this->gatherPart();
    const LocalPart part(corners_);
    FacetThinner thinner(mesh_, part, planes_, plane_);
    if (thinner.run())
    {
      this->writeBack(part, thinner);
    }
  }

private:
  bool isAtCut(const Triangle& corner) const
  {
    return std::any_of(corner.begin(), corner.end(),
      [&](std::int32_t point) { return std::size_t(point) >= result_.firstCut; });
  }

  // Into planes_, -1 for triangles of a facet that is not at the cut.
  std::int32_t planeAt(std::size_t t) const
  {
    return facets_.of[t] < 0 ? -1 : planeOf_[std::size_t(facets_.of[t])];
  }

  void findPlanes()
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) < 0 && facets_.of[t] >= 0 && this->isAtCut(mesh_.triangles[t]))
      {
        planeOf_[std::size_t(facets_.of[t])] = std::int32_t(planes_.size());
        planes_.emplace_back();
      }
    }
  }

  template <class Visit>
  void forEachAtCut(Visit&& visit)
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) >= 0)
      {
        visit(t, planes_[std::size_t(this->planeAt(t))]);
      }
    }
  }

  // Whether there is a facet of parts.
  bool measurePlanes()
  {
    bool any = false;
    double largest = 0.0;
    for (const Vec3& p : mesh_.points)
    {
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    this->forEachAtCut(
      [&](std::size_t t, FacetPlane& plane)
      {
        const std::int32_t source = result_.sourceTriangle[t];
        plane.hasParts = plane.hasParts || (plane.source >= 0 && plane.source != source);
        plane.source = source;
        plane.normal += areaNormal(mesh_, t);
        any = any || plane.hasParts;
      });
    if (!any)
    {
      return false;
    }
    for (FacetPlane& plane : planes_)
    {
      plane.normal.stableNormalize();
    }
    this->forEachAtCut(
      [&](std::size_t t, FacetPlane& plane)
      {
        for (const std::int32_t point : mesh_.triangles[t])
        {
          const Vec3& p = mesh_.points[std::size_t(point)];
          plane.along[0] = std::min(plane.along[0], plane.normal.dot(p));
          plane.along[1] = std::max(plane.along[1], plane.normal.dot(p));
          plane.box.extend(p);
        }
      });
    for (FacetPlane& plane : planes_)
    {
      plane.tolerance = kRounding * largest + kOffPlane * plane.box.sizes().norm();
      plane.isFlat = plane.along[1] - plane.along[0] <= plane.tolerance;
    }
    return true;
  }

  // The facets that may change, and all triangles around their points.
  void gatherPart()
  {
    std::vector<char> near(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) >= 0 && planes_[std::size_t(this->planeAt(t))].isFlat)
      {
        for (const std::int32_t point : mesh_.triangles[t])
        {
          near[std::size_t(point)] = 1;
        }
      }
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& corner = mesh_.triangles[t];
      if (std::any_of(corner.begin(), corner.end(),
            [&](std::int32_t point) { return near[std::size_t(point)] != 0; }))
      {
        triangles_.push_back(std::int32_t(t));
        corners_.push_back(corner);
        plane_.push_back(this->planeAt(t));
      }
    }
  }

  void writeBack(const LocalPart& part, const FacetThinner& thinner)
  {
    part.write(thinner.links(), corners_);
    for (std::size_t k = 0; k < triangles_.size(); ++k)
    {
      mesh_.triangles[std::size_t(triangles_[k])] = corners_[k];
    }
    std::vector<std::int32_t> becomes(mesh_.points.size());
    std::iota(becomes.begin(), becomes.end(), 0);
    for (const std::array<Index, 2>& merge : thinner.merged)
    {
      becomes[std::size_t(part.pointOf[std::size_t(merge[0])])] =
        part.pointOf[std::size_t(merge[1])];
    }
    compactResult(result_, becomes);
  }

  MeshBooleanResult& result_;
  TriangleMesh& mesh_;
  const Facets& facets_;
  std::vector<std::int32_t> planeOf_; // per facet: into planes_, -1 for one away from the cut
  std::vector<FacetPlane> planes_;
  std::vector<std::int32_t> triangles_; // of the part
  std::vector<Triangle> corners_;       // theirs
  std::vector<std::int32_t> plane_;     // theirs
};

} // namespace

Facets facetsOf(const MeshBooleanResult& result, const std::array<Facets, 2>& operands,
  const std::array<std::size_t, 2>& triangles)
{
  std::array<std::int32_t, 2> count{};
  for (std::size_t k = 0; k < 2; ++k)
  {
    count[k] = operands[k].of.empty() ? std::int32_t(triangles[k]) : operands[k].count;
  }
  Facets facets;
  facets.count = count[0] + count[1];
  facets.of.reserve(result.mesh.triangles.size());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    const std::size_t operand = std::size_t(result.sourceOperand[t]);
    const std::int32_t source = result.sourceTriangle[t];
    const std::int32_t facet = source < 0 ? -1 : operands[operand].at(source);
    facets.of.push_back(facet < 0 ? -1 : facet + (operand == 0 ? 0 : count[0]));
  }
  return facets;
}

void mergeFacets(MeshBooleanResult& result, const Facets& facets)
{
  Merger(result, facets).run();
}

} // namespace hybridtree
