// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/GradeCut.h"

#include "core/stitch/CutZone.h"
#include "core/stitch/RefineFacets.h"
#include "core/stitch/TriangleShape.h"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace hybridtree
{
namespace
{

using Index = std::int32_t;

constexpr double kFew = 0.01;      // of the triangles: slivers that are no reason to grow
constexpr double kSliver = 0.9848; // cosine of 10 degrees
constexpr double kRounding = 1e-9; // of weights
constexpr double kLeast = 0.3;     // cells: shorter sides are left to PatchShape.h

class Grader
{
public:
  Grader(const TriangleMesh& mesh, CutZone& zone, double cellSize, CutMesh& cut)
    : mesh_(mesh)
    , zone_(zone)
    , least_(kLeast * cellSize)
    , cut_(cut)
    , points_(static_cast<Index>(mesh.points.size()))
  {
  }

  void run()
  {
    if (this->refineBest())
    {
      this->takePieces();
      this->takeTriangles();
    }
  }

private:
  const Vec3& point(Index v) const
  {
    return v < points_ ? mesh_.points[v] : cut_.vertices[v - points_].point;
  }

  /// Once more with what lies beyond the zone, if there are slivers left at its border and that
  /// helps; triangles there may be needles in themselves. \return whether it is better now.
  bool refineBest()
  {
    const bool better = this->refine();
    const double slivers = this->shareOfSlivers();
    const std::size_t count = zone_.triangles().size();
    if (slivers <= kFew || !zone_.growBeyond(this->sidesOfSlivers()))
    {
      return better;
    }
    if (this->refine() && (!better || this->shareOfSlivers() < slivers))
    {
      return true;
    }
    zone_.shrink(count);
    return better && this->refine();
  }

  bool refine()
  {
    this->collect();
    return refineFacets(facets_, least_);
  }

  double shareOfSlivers() const
  {
    const auto slivers = std::count_if(facets_.triangles.begin(), facets_.triangles.end(),
      [&](const Triangle& c) { return this->isSliver(c); });
    return static_cast<double>(slivers) / static_cast<double>(facets_.triangles.size());
  }

  /// Those with very short sides are mended later, otherwise.
  bool isSliver(const Triangle& c) const
  {
    const Vec3& p = facets_.points[c[0]];
    const Vec3& q = facets_.points[c[1]];
    const Vec3& r = facets_.points[c[2]];
    return shapeOf(p, q, r) > kSliver &&
      std::min({ (q - p).norm(), (r - q).norm(), (p - r).norm() }) >= least_;
  }

  void collect()
  {
    zone_.findFacets();
    facets_ = {};
    facets_.normals = zone_.normals();
    numbers_.clear();
    vertices_.clear();
    for (std::size_t k = 0; k < cut_.pieces.size(); ++k)
    {
      const Index place = zone_.placeOf(cut_.pieceOf[k]);
      if (place >= 0)
      {
        this->addTriangle(cut_.pieces[k], zone_.facets()[place]);
      }
    }
    for (std::size_t k = zone_.cutTriangles(); k < zone_.triangles().size(); ++k)
    {
      this->addTriangle(mesh_.triangles[zone_.triangles()[k]], zone_.facets()[k]);
    }
  }

  void addTriangle(const Triangle& corners, Index facet)
  {
    Triangle numbered;
    for (int k = 0; k < 3; ++k)
    {
      const auto [found, isNew] =
        numbers_.try_emplace(corners[k], static_cast<Index>(facets_.points.size()));
      if (isNew)
      {
        facets_.points.push_back(this->point(corners[k]));
        vertices_.push_back(corners[k]);
      }
      numbered[k] = found->second;
    }
    facets_.triangles.push_back(numbered);
    facets_.facet.push_back(facet);
  }

  /// Sides of the mesh at the border of the zone that slivers are at, or fan out from an end of: as
  /// long as they are not parted there will be some.
  std::vector<CutZone::Side> sidesOfSlivers() const
  {
    std::set<CutZone::Side> all;
    for (const Triangle& c : facets_.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        all.insert({ c[k], c[(k + 1) % 3] });
      }
    }
    const std::vector<bool> isEnd = this->endsOfNeedles();
    std::vector<CutZone::Side> sides;
    for (const auto& [from, to] : all)
    {
      if (isMeshPoint(from) && isMeshPoint(to) && (isEnd[from] || isEnd[to]) &&
        all.count({ to, from }) == 0)
      {
        sides.push_back({ vertices_[from], vertices_[to] });
      }
    }
    return sides;
  }

  bool isMeshPoint(Index v) const
  {
    return static_cast<std::size_t>(v) < vertices_.size() && vertices_[v] < points_;
  }

  /// Points of slivers but for the ends of very short sides.
  std::vector<bool> endsOfNeedles() const
  {
    std::vector<bool> isEnd(facets_.points.size(), false);
    for (const Triangle& c : facets_.triangles)
    {
      if (this->isSliver(c))
      {
        isEnd[c[0]] = isEnd[c[1]] = isEnd[c[2]] = true;
      }
    }
    return isEnd;
  }

  /// Those of the zone that were whole are made anew with the others.
  void takeTriangles()
  {
    const auto first =
      zone_.triangles().begin() + static_cast<std::ptrdiff_t>(zone_.cutTriangles());
    for (std::vector<Index>* list : { &cut_.gone, &cut_.cutTriangles })
    {
      list->insert(list->end(), first, zone_.triangles().end());
      std::sort(list->begin(), list->end());
    }
  }

  void takePieces()
  {
    std::vector<std::vector<Index>> members(zone_.normals().size());
    for (std::size_t k = 0; k < zone_.triangles().size(); ++k)
    {
      members[zone_.facets()[k]].push_back(zone_.triangles()[k]);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < cut_.pieces.size(); ++k)
    {
      if (zone_.placeOf(cut_.pieceOf[k]) < 0)
      {
        cut_.pieces[kept] = cut_.pieces[k];
        cut_.pieceOf[kept++] = cut_.pieceOf[k];
      }
    }
    cut_.pieces.resize(kept);
    cut_.pieceOf.resize(kept);
    cut_.isPart.assign(kept, true);
    vertices_.resize(facets_.points.size(), -1);
    for (std::size_t t = 0; t < facets_.triangles.size(); ++t)
    {
      this->takePiece(facets_.triangles[t], members[facets_.facet[t]]);
    }
  }

  /// \param members triangles of its facet.
  void takePiece(const Triangle& corners, const std::vector<Index>& members)
  {
    Triangle piece;
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      Index& v = vertices_[corners[k]];
      const Vec3& p = facets_.points[corners[k]];
      middle += p / 3.0;
      if (v < 0)
      {
        v = points_ + static_cast<Index>(cut_.vertices.size());
        cut_.vertices.push_back(cutVertexOn(mesh_, this->holder(members, p), p));
      }
      piece[k] = v;
    }
    const Index of = this->holder(members, middle);
    cut_.pieces.push_back(piece);
    cut_.pieceOf.push_back(of);
    cut_.isPart.push_back(members.size() == 1 ||
      std::all_of(corners.begin(), corners.end(),
        [&](Index v) { return this->depth(of, facets_.points[v]) > -kRounding; }));
  }

  /// That of a plane in which a point lies.
  Index holder(const std::vector<Index>& members, const Vec3& p) const
  {
    Index best = members.front();
    double deepest = members.size() > 1 ? this->depth(best, p) : 0.0;
    for (std::size_t k = 1; k < members.size() && deepest < 0.0; ++k)
    {
      const double depth = this->depth(members[k], p);
      if (depth > deepest)
      {
        deepest = depth;
        best = members[k];
      }
    }
    return best;
  }

  /// The least weight of a corner.
  double depth(Index t, const Vec3& p) const
  {
    const Triangle& c = mesh_.triangles[t];
    const Vec3 normal = areaNormal(mesh_, static_cast<std::size_t>(t));
    const double squared = normal.squaredNorm();
    if (!(squared > 0.0))
    {
      return -1e300;
    }
    double least = 1.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& a = mesh_.points[c[k]];
      const Vec3& b = mesh_.points[c[(k + 1) % 3]];
      least = std::min(least, (b - a).cross(p - a).dot(normal) / squared);
    }
    return least;
  }

  const TriangleMesh& mesh_;
  CutZone& zone_;
  const double least_;
  CutMesh& cut_;
  const Index points_;
  FacetMesh facets_;
  std::unordered_map<Index, Index> numbers_; ///< of a vertex, in facets_
  std::vector<Index> vertices_;              ///< and back
};

} // namespace

void gradeCut(const TriangleMesh& mesh, const KeptMesh& known, double cellSize, CutMesh& cut)
{
  CutZone zone(mesh, known, cut, cellSize);
  if (!zone.triangles().empty())
  {
    Grader(mesh, zone, cellSize, cut).run();
  }
}

} // namespace hybridtree
