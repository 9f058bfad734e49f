// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CutZone.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using Index = CutZone::Index;

constexpr double kLong = 2.0;  // distances from the cut
constexpr double kFlat = 1e-6; // of the largest coordinate
constexpr std::size_t kMostTriangles = 4000;

double squaredDistance(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 way = b - a;
  const double squared = way.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((p - a).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (a + share * way - p).squaredNorm();
}

/// The plane of triangles of nearly one plane, told by all of them: that of a needle says little.
class FlatRegion
{
public:
  void add(const TriangleMesh& mesh, Index t)
  {
    const Vec3 twiceArea = areaNormal(mesh, static_cast<std::size_t>(t));
    const double size = twiceArea.norm();
    sum_ += twiceArea;
    weight_ += size;
    moment_ += size * middle(mesh, t);
  }

  bool contains(const TriangleMesh& mesh, Index t, double most) const
  {
    const Vec3 twiceArea = areaNormal(mesh, static_cast<std::size_t>(t));
    const double size = twiceArea.norm();
    const Vec3 up = (sum_ + twiceArea).stableNormalized();
    const Vec3 origin = (moment_ + size * middle(mesh, t)) / (weight_ + size);
    return up.dot(twiceArea) > 0.0 &&
      std::all_of(mesh.triangles[t].begin(), mesh.triangles[t].end(),
        [&](Index v) { return std::abs(up.dot(mesh.points[v] - origin)) <= most; });
  }

  Vec3 normal() const { return sum_.stableNormalized(); }

private:
  static Vec3 middle(const TriangleMesh& mesh, Index t)
  {
    const Triangle& c = mesh.triangles[t];
    return (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0;
  }

  Vec3 sum_ = Vec3::Zero();
  Vec3 moment_ = Vec3::Zero();
  double weight_ = 0.0;
};

} // namespace

CutZone::CutZone(
  const TriangleMesh& mesh, const KeptMesh& known, const CutMesh& cut, double cellSize)
  : mesh_(mesh), around_(known.pointTriangles()), cut_(cut), cellSize_(cellSize)
{
  for (const Index t : cut_.cutTriangles)
  {
    if (this->isLarge(this->corner(t, 0), this->corner(t, 1)) ||
      this->isLarge(this->corner(t, 1), this->corner(t, 2)) ||
      this->isLarge(this->corner(t, 2), this->corner(t, 0)))
    {
      this->add(t);
    }
  }
  cutTriangles_ = triangles_.size();
  if (!triangles_.empty())
  {
    this->findLine();
  }
}

CutZone::Index CutZone::placeOf(Index triangle) const
{
  const auto found = place_.find(triangle);
  return found == place_.end() ? -1 : found->second;
}

bool CutZone::isLarge(const Vec3& a, const Vec3& b) const
{
  return isLarge((b - a).norm(), cellSize_);
}

void CutZone::add(Index t)
{
  place_[t] = static_cast<Index>(triangles_.size());
  triangles_.push_back(t);
}

/// The triangle that has a side in this direction.
CutZone::Index CutZone::owner(Index from, Index to) const
{
  const Index* const of = around_.of(from);
  const Index* const end = of + around_.count(from);
  const Index* const found = std::find_if(of, end,
    [&](Index t)
    {
      const Triangle& c = mesh_.triangles[t];
      return (c[0] == from && c[1] == to) || (c[1] == from && c[2] == to) ||
        (c[2] == from && c[0] == to);
    });
  return found == end ? -1 : *found;
}

bool CutZone::addBeyond(Index from, Index to)
{
  const Index beyond = this->owner(to, from);
  if (beyond < 0 || this->placeOf(beyond) >= 0 || triangles_.size() >= kMostTriangles ||
    std::binary_search(cut_.gone.begin(), cut_.gone.end(), beyond))
  {
    return false;
  }
  this->add(beyond);
  return true;
}

bool CutZone::growBeyond(const std::vector<Side>& sides)
{
  const std::size_t before = triangles_.size();
  for (const auto& [from, to] : sides)
  {
    if (this->isLarge(mesh_.points[from], mesh_.points[to]))
    {
      this->addBeyond(from, to);
    }
  }
  for (std::size_t k = before; k < triangles_.size(); ++k)
  {
    const Triangle& c = mesh_.triangles[triangles_[k]];
    for (int side = 0; side < 3; ++side)
    {
      if (this->isNearForItsLength(mesh_.points[c[side]], mesh_.points[c[(side + 1) % 3]]))
      {
        this->addBeyond(c[side], c[(side + 1) % 3]);
      }
    }
  }
  return triangles_.size() > before;
}

void CutZone::shrink(std::size_t count)
{
  while (triangles_.size() > count)
  {
    place_.erase(triangles_.back());
    triangles_.pop_back();
  }
}

void CutZone::findLine()
{
  const auto points = static_cast<Index>(mesh_.points.size());
  for (const BorderSegment& segment : cut_.segments)
  {
    const Index v = segment.from;
    line_.push_back(v < points ? mesh_.points[v] : cut_.vertices[v - points].point);
  }
}

bool CutZone::isNearForItsLength(const Vec3& a, const Vec3& b) const
{
  const double squared = (b - a).squaredNorm();
  return this->isLarge(a, b) &&
    std::any_of(line_.begin(), line_.end(),
      [&](const Vec3& p) { return kLong * kLong * squaredDistance(p, a, b) < squared; });
}

/// From the largest triangles, whose planes are told best.
void CutZone::findFacets()
{
  std::vector<std::pair<double, Index>> bySize;
  double largest = 0.0;
  for (std::size_t k = 0; k < triangles_.size(); ++k)
  {
    const Index t = triangles_[k];
    bySize.push_back(
      { -areaNormal(mesh_, static_cast<std::size_t>(t)).squaredNorm(), static_cast<Index>(k) });
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, this->corner(t, c).cwiseAbs().maxCoeff());
    }
  }
  std::sort(bySize.begin(), bySize.end());
  facets_.assign(triangles_.size(), -1);
  normals_.clear();
  for (const auto& [size, k] : bySize)
  {
    if (facets_[k] < 0)
    {
      this->collectFacet(k, kFlat * largest);
    }
  }
}

void CutZone::collectFacet(Index seed, double most)
{
  const auto facet = static_cast<Index>(normals_.size());
  facets_[seed] = facet;
  FlatRegion plane;
  plane.add(mesh_, triangles_[seed]);
  std::vector<Index> waiting{ seed };
  for (std::size_t k = 0; k < waiting.size(); ++k)
  {
    const Triangle& c = mesh_.triangles[triangles_[waiting[k]]];
    for (int side = 0; side < 3; ++side)
    {
      const Index next = this->placeOf(this->owner(c[(side + 1) % 3], c[side]));
      if (next >= 0 && facets_[next] < 0 && plane.contains(mesh_, triangles_[next], most))
      {
        facets_[next] = facet;
        plane.add(mesh_, triangles_[next]);
        waiting.push_back(next);
      }
    }
  }
  normals_.push_back(plane.normal());
}

} // namespace hybridtree
