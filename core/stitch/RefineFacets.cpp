// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/RefineFacets.h"

#include "core/stitch/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace hybridtree
{
namespace
{

using Index = FacetTriangulation::Index;
using Side = FacetTriangulation::Side;
using Cavity = FacetTriangulation::Cavity;
using Kind = FacetTriangulation::Kind;

constexpr double kSliver = 0.9848;    // cosine of 10 degrees
constexpr double kGoodShape = 0.9613; // cosine of 16 degrees, which is aimed at
constexpr double kSteps = 2.3;        // lengths of a side to where it is seen under 25 degrees
constexpr double kLeastHeight = 0.2;  // of a point over a fixed side, to the nearer end
constexpr int kMostSteps = 300;       // of a walk
constexpr std::size_t kPointsPerPoint = 6;
constexpr std::size_t kMorePoints = 2000;

class FacetRefiner
{
public:
  FacetRefiner(FacetMesh mesh, double least)
    : least_(least)
    , onCrease_(mesh.points.size(), false)
    , mostPoints_(kPointsPerPoint * mesh.points.size() + kMorePoints)
    , facets_(std::move(mesh))
  {
  }

  FacetMesh run()
  {
    facets_.flipAll();
    versions_.assign(facets_.triangleCount(), 0);
    for (Index t = 0; t < static_cast<Index>(facets_.triangleCount()); ++t)
    {
      this->consider(t);
    }
    while (!waiting_.empty() && facets_.pointCount() < mostPoints_)
    {
      const auto [shape, t, version] = waiting_.top();
      waiting_.pop();
      if (version == versions_[t])
      {
        this->mend(t);
      }
    }
    return facets_.take();
  }

private:
  using Waiting = std::tuple<double, Index, int>; // shape, triangle, its version

  double length(const Side& side) const
  {
    return (facets_.point(side.to) - facets_.point(side.from)).norm();
  }

  void consider(Index t)
  {
    const double shape = facets_.shape(t);
    if (shape > kGoodShape && !facets_.isFrozen(t))
    {
      waiting_.push({ shape, t, versions_[t] });
    }
  }

  void considerAll(const std::vector<Index>& changed)
  {
    versions_.resize(facets_.triangleCount(), 0);
    for (const Index t : changed)
    {
      ++versions_[t];
      this->consider(t);
    }
  }

  /// A point over the shortest side of a triangle, from where it is seen under a good angle, or in
  /// the centre of the circle around the triangle if that is nearer; or first one on a crease that
  /// is between, or too near.
  void mend(Index t)
  {
    Triangle c = facets_.triangle(t);
    const auto sideLength = [&](int k) { return this->length({ c[k], c[(k + 1) % 3] }); };
    const double lengths[3] = { sideLength(0), sideLength(1), sideLength(2) };
    const auto shortest = std::min_element(lengths, lengths + 3) - lengths;
    if (lengths[shortest] < least_)
    {
      return;
    }
    std::rotate(c.begin(), c.begin() + shortest, c.end());
    if (this->isGivenAngle(c))
    {
      return;
    }
    const Vec3& from = facets_.point(c[0]);
    const Vec3 side = facets_.point(c[1]) - from;
    const Vec3 other = facets_.point(c[2]) - from;
    const Vec3& up = facets_.normal(t);
    const double toCentre =
      (other.squaredNorm() - other.dot(side)) / (2.0 * up.dot(side.cross(other)));
    const Vec3 at = from + 0.5 * side + std::min(toCentre, kSteps) * up.cross(side);
    if (at.allFinite())
    {
      this->insert(at, t);
    }
  }

  /// The smallest angle of a triangle, whose shortest side comes first, is one of the facet.
  bool isGivenAngle(const Triangle& c) const
  {
    return facets_.kind({ c[1], c[2] }) != Kind::Free && facets_.kind({ c[2], c[0] }) != Kind::Free;
  }

  void insert(const Vec3& at, Index t)
  {
    Side blocking{};
    const Index around = this->walk(at, t, blocking);
    if (around == FacetTriangulation::kNone)
    {
      this->splitCreaseBefore(t, blocking);
      return;
    }
    const Cavity cavity = facets_.cavityOf(at, around);
    if (!cavity.good)
    {
      return;
    }
    for (const Side& side : cavity.border)
    {
      if (this->isTooNear(at, side))
      {
        if (this->splitCreaseBefore(t, side) || this->isFlatOver(at, side))
        {
          return;
        }
      }
    }
    std::vector<Index> changed;
    facets_.insert(at, cavity, changed);
    onCrease_.push_back(false);
    this->considerAll(changed);
  }

  /// Where that changes the triangle it waits already, as a new one.
  bool splitCreaseBefore(Index t, const Side& side)
  {
    const int version = versions_[t];
    if (!this->splitCrease(side))
    {
      return false;
    }
    if (versions_[t] == version)
    {
      this->consider(t);
    }
    return true;
  }

  /// The triangle of the facet in which a point lies; none where a side that is not free is on the
  /// way there.
  Index walk(const Vec3& at, Index t, Side& blocking) const
  {
    for (int step = 0; step < kMostSteps; ++step)
    {
      const Triangle& c = facets_.triangle(t);
      double worst = 0.0;
      int across = -1;
      for (int k = 0; k < 3; ++k)
      {
        const Side side{ c[k], c[(k + 1) % 3] };
        const double height = facets_.area(t, side.from, side.to, at) / this->length(side);
        if (height < worst)
        {
          worst = height;
          across = k;
        }
      }
      if (across < 0)
      {
        return t;
      }
      blocking = { c[across], c[(across + 1) % 3] };
      if (facets_.kind(blocking) != Kind::Free)
      {
        return FacetTriangulation::kNone;
      }
      t = facets_.owner({ blocking.to, blocking.from });
    }
    blocking = { 0, 0 };
    return FacetTriangulation::kNone;
  }

  /// Within the circle over a side that is not free.
  bool isTooNear(const Vec3& at, const Side& side) const
  {
    return facets_.kind(side) != Kind::Free &&
      (facets_.point(side.from) - at).dot(facets_.point(side.to) - at) < 0.0;
  }

  bool isFlatOver(const Vec3& at, const Side& side) const
  {
    const Vec3 from = at - facets_.point(side.from);
    const Vec3 to = at - facets_.point(side.to);
    const Vec3 way = facets_.point(side.to) - facets_.point(side.from);
    const double nearer = std::min(from.norm(), to.norm());
    return way.cross(from).norm() < kLeastHeight * nearer * way.norm();
  }

  /// Near the middle, where points on all creases from a corner are as far from it.
  double shareOfSplit(const Side& side, double length) const
  {
    const bool fromCorner = !onCrease_[side.from];
    if (fromCorner == !onCrease_[side.to])
    {
      return 0.5;
    }
    const double shell = least_ * std::exp2(std::round(std::log2(0.5 * length / least_)));
    const double share = std::clamp(shell / length, 0.3, 0.7);
    return fromCorner ? share : 1.0 - share;
  }

  bool splitCrease(const Side& side)
  {
    if (side.from == side.to || facets_.kind(side) != Kind::Crease)
    {
      return false;
    }
    const double length = this->length(side);
    if (length < 2.0 * least_)
    {
      return false;
    }
    const Vec3 way = facets_.point(side.to) - facets_.point(side.from);
    const Vec3 at = facets_.point(side.from) + this->shareOfSplit(side, length) * way;
    const Side back{ side.to, side.from };
    const Cavity left = facets_.cavityOf(at, side);
    const Cavity right = facets_.cavityOf(at, back);
    if (!left.good || !right.good)
    {
      return false;
    }
    std::vector<Index> changed;
    facets_.insert(at, left, right, changed);
    onCrease_.push_back(true);
    this->considerAll(changed);
    return true;
  }

  const double least_;
  std::vector<bool> onCrease_; ///< per point: it was put on one
  const std::size_t mostPoints_;
  FacetTriangulation facets_;
  std::vector<int> versions_; ///< per triangle
  std::priority_queue<Waiting> waiting_;
};

double shareOfSlivers(const FacetMesh& mesh)
{
  const auto slivers = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
    [&](const Triangle& c)
    { return shapeOf(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) > kSliver; });
  return static_cast<double>(slivers) / static_cast<double>(mesh.triangles.size());
}

} // namespace

bool refineFacets(FacetMesh& mesh, double least)
{
  const double before = mesh.triangles.empty() ? 0.0 : shareOfSlivers(mesh);
  if (before == 0.0)
  {
    return false;
  }
  FacetMesh refined = FacetRefiner(mesh, least).run();
  const bool better = shareOfSlivers(refined) < before;
  if (better)
  {
    mesh = std::move(refined);
  }
  return better;
}

} // namespace hybridtree
