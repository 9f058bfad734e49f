// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/FacetTriangulation.h"

#include "core/stitch/TriangleShape.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kRounding = 1e-9;  // of squared lengths
constexpr double kInCircle = 1e-10; // of fourth powers of lengths
constexpr std::size_t kMostInCavity = 500;

} // namespace

FacetTriangulation::FacetTriangulation(FacetMesh mesh)
  : mesh_(std::move(mesh)), owner_(6 * mesh_.triangles.size())
{
  frozen_.assign(mesh_.normals.size(), false);
  this->freeze();
  for (Index t = 0; t < static_cast<Index>(mesh_.triangles.size()); ++t)
  {
    this->link(t);
  }
}

void FacetTriangulation::freeze()
{
  SideTable known(3 * mesh_.triangles.size());
  for (Index t = 0; t < static_cast<Index>(mesh_.triangles.size()); ++t)
  {
    const Triangle& c = mesh_.triangles[t];
    const double size = (this->point(c[1]) - this->point(c[0])).squaredNorm() +
      (this->point(c[2]) - this->point(c[0])).squaredNorm();
    if (!(this->area(t, c[0], c[1], this->point(c[2])) > -kRounding * size))
    {
      frozen_[mesh_.facet[t]] = true;
    }
    for (int k = 0; k < 3; ++k)
    {
      // A side that two have in the same direction: no surface to work on.
      const Index other = known.find(c[k], c[(k + 1) % 3]);
      if (other == kNone)
      {
        known.put(c[k], c[(k + 1) % 3], t);
        continue;
      }
      frozen_[mesh_.facet[t]] = true;
      frozen_[mesh_.facet[other]] = true;
    }
  }
}

void FacetTriangulation::link(Index t)
{
  const Triangle& c = mesh_.triangles[t];
  for (int k = 0; k < 3; ++k)
  {
    owner_.put(c[k], c[(k + 1) % 3], t);
  }
}

void FacetTriangulation::unlink(Index t)
{
  const Triangle& c = mesh_.triangles[t];
  for (int k = 0; k < 3; ++k)
  {
    owner_.erase(c[k], c[(k + 1) % 3]);
  }
}

FacetTriangulation::Kind FacetTriangulation::kind(const Side& side) const
{
  const Index left = this->owner(side);
  const Index right = this->owner({ side.to, side.from });
  if (left == kNone || right == kNone || this->isFrozen(left) || this->isFrozen(right))
  {
    return Kind::Fixed;
  }
  return mesh_.facet[left] == mesh_.facet[right] ? Kind::Free : Kind::Crease;
}

double FacetTriangulation::shape(Index t) const
{
  const Triangle& c = mesh_.triangles[t];
  return shapeOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
}

double FacetTriangulation::area(Index t, Index a, Index b, const Vec3& p) const
{
  const Vec3& from = this->point(a);
  return this->normal(t).dot((this->point(b) - from).cross(p - from));
}

void FacetTriangulation::flipAll()
{
  std::vector<Side> waiting;
  for (const Triangle& c : mesh_.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (c[k] < c[(k + 1) % 3])
      {
        waiting.push_back({ c[k], c[(k + 1) % 3] });
      }
    }
  }
  std::size_t left = 100 * mesh_.triangles.size(); // rounding could make it go on forever
  while (!waiting.empty() && left-- > 0)
  {
    const Side side = waiting.back();
    waiting.pop_back();
    if (this->kind(side) == Kind::Free)
    {
      this->flip(side, waiting);
    }
  }
}

bool FacetTriangulation::flip(const Side& side, std::vector<Side>& waiting)
{
  const auto [a, b] = side;
  const Index t = this->owner(side);
  const Index s = this->owner({ b, a });
  const auto opposite = [&](Index of)
  {
    const Triangle& corners = mesh_.triangles[of];
    return corners[0] + corners[1] + corners[2] - a - b;
  };
  const Index c = opposite(t);
  const Index d = opposite(s);
  // The angles across the edge: flipped where they sum to more than a half turn.
  const Vec3 ca = this->point(a) - this->point(c), cb = this->point(b) - this->point(c);
  const Vec3 da = this->point(a) - this->point(d), db = this->point(b) - this->point(d);
  const Vec3& up = this->normal(t);
  const double sine = up.dot(ca.cross(cb)) * da.dot(db) + ca.dot(cb) * up.dot(db.cross(da));
  const double scale =
    (ca.squaredNorm() + cb.squaredNorm()) * (da.squaredNorm() + db.squaredNorm());
  const double least = kRounding * (this->point(c) - this->point(d)).squaredNorm();
  if (!(sine < -kRounding * scale) || !(this->area(t, a, d, this->point(c)) > least) ||
    !(this->area(t, d, b, this->point(c)) > least) || this->owner({ c, d }) != kNone ||
    this->owner({ d, c }) != kNone)
  {
    return false;
  }
  this->unlink(t);
  this->unlink(s);
  mesh_.triangles[t] = { a, d, c };
  mesh_.triangles[s] = { d, b, c };
  this->link(t);
  this->link(s);
  waiting.insert(waiting.end(), { { a, d }, { d, b }, { b, c }, { c, a } });
  return true;
}

bool FacetTriangulation::isInCircle(const Vec3& p, Index t) const
{
  const Triangle& c = mesh_.triangles[t];
  const Vec3 x = this->point(c[0]) - p;
  const Vec3 y = this->point(c[1]) - p;
  const Vec3 z = this->point(c[2]) - p;
  const Vec3& up = this->normal(t);
  const double xx = x.squaredNorm(), yy = y.squaredNorm(), zz = z.squaredNorm();
  const double inside = xx * up.dot(y.cross(z)) + yy * up.dot(z.cross(x)) + zz * up.dot(x.cross(y));
  const double most = std::max({ xx, yy, zz });
  return inside > kInCircle * most * most;
}

void FacetTriangulation::grow(const Vec3& p, const Side* without, Cavity& cavity) const
{
  for (std::size_t k = 0; k < cavity.triangles.size(); ++k)
  {
    const Triangle& c = mesh_.triangles[cavity.triangles[k]];
    for (int corner = 0; corner < 3; ++corner)
    {
      const Side side{ c[corner], c[(corner + 1) % 3] };
      if (without && side.from == without->from && side.to == without->to)
      {
        continue;
      }
      const Index beyond = this->owner({ side.to, side.from });
      const bool known = beyond != kNone &&
        std::find(cavity.triangles.begin(), cavity.triangles.end(), beyond) !=
          cavity.triangles.end();
      if (known && this->kind(side) == Kind::Free)
      {
        continue;
      }
      if (!known && beyond != kNone && this->kind(side) == Kind::Free &&
        cavity.triangles.size() < kMostInCavity && this->isInCircle(p, beyond))
      {
        cavity.triangles.push_back(beyond);
        continue;
      }
      cavity.border.push_back(side);
    }
  }
  // A triangle that joined late may be beyond a side that was taken for border before.
  const auto isWithin = [&](const Side& side)
  {
    return this->kind(side) == Kind::Free &&
      std::find(cavity.triangles.begin(), cavity.triangles.end(),
        this->owner({ side.to, side.from })) != cavity.triangles.end();
  };
  cavity.border.erase(
    std::remove_if(cavity.border.begin(), cavity.border.end(), isWithin), cavity.border.end());
  cavity.good = std::all_of(cavity.border.begin(), cavity.border.end(),
    [&](const Side& side)
    {
      const double size = (this->point(side.to) - this->point(side.from)).squaredNorm();
      return this->area(cavity.triangles.front(), side.from, side.to, p) > 1e-6 * size;
    });
  cavity.good = cavity.good &&
    cavity.border.size() == cavity.triangles.size() + (without ? 1 : 2); // else it has a hole
}

FacetTriangulation::Cavity FacetTriangulation::cavityOf(const Vec3& p, Index t) const
{
  Cavity cavity;
  cavity.triangles.push_back(t);
  this->grow(p, nullptr, cavity);
  return cavity;
}

FacetTriangulation::Cavity FacetTriangulation::cavityOf(const Vec3& p, const Side& side) const
{
  Cavity cavity;
  cavity.triangles.push_back(this->owner(side));
  this->grow(p, &side, cavity);
  return cavity;
}

FacetTriangulation::Index FacetTriangulation::insert(
  const Vec3& p, const Cavity& cavity, std::vector<Index>& changed)
{
  const auto made = static_cast<Index>(mesh_.points.size());
  mesh_.points.push_back(p);
  this->fill(made, cavity, changed);
  return made;
}

FacetTriangulation::Index FacetTriangulation::insert(
  const Vec3& p, const Cavity& left, const Cavity& right, std::vector<Index>& changed)
{
  const Index made = this->insert(p, left, changed);
  this->fill(made, right, changed);
  return made;
}

void FacetTriangulation::fill(Index v, const Cavity& cavity, std::vector<Index>& changed)
{
  const Index facet = mesh_.facet[cavity.triangles.front()];
  for (const Index t : cavity.triangles)
  {
    this->unlink(t);
  }
  for (std::size_t k = 0; k < cavity.border.size(); ++k)
  {
    const Side& side = cavity.border[k];
    auto t = static_cast<Index>(mesh_.triangles.size());
    if (k < cavity.triangles.size())
    {
      t = cavity.triangles[k];
    }
    else
    {
      mesh_.triangles.emplace_back();
      mesh_.facet.push_back(facet);
    }
    mesh_.triangles[t] = { side.from, side.to, v };
    this->link(t);
    changed.push_back(t);
  }
}

} // namespace hybridtree
