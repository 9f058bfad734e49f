// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateMesh.h"

#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/PlateFace.h"
#include "core/skeletons/PlateRim.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

double areaOf(const std::vector<Vec2>& corners)
{
  double twice = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec2& a = corners[k];
    const Vec2& b = corners[(k + 1) % corners.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

// Rings of points around the rim, from the outline of the upper face over the equator to that of
// the lower one, and the two faces inside of the first and the last.
class PlateMesher
{
public:
  PlateMesher(const PlateShape& plate, double radius, std::vector<PlateRim::Ring> rings)
    : plate_(plate)
    , radius_(radius)
    , rings_(std::move(rings))
    , halfRings_(static_cast<int>(rings_.size()) - 1)
  {
    for (const PlateRim::Ring& ring : rings_)
    {
      std::size_t size = 0;
      for (const auto& chain : ring)
      {
        size += chain.size() - 1;
      }
      sizes_.push_back(static_cast<int>(size));
    }
  }

  // The rim. Returns the length of its longest edge.
  double makeRim()
  {
    // The faces have some as many points again.
    const auto count = std::accumulate(sizes_.begin(), sizes_.end(), std::size_t(0));
    mesh_.points.reserve(4 * count);
    mesh_.normals.reserve(4 * count);
    mesh_.triangles.reserve(8 * count);
    for (int k = 0; k <= halfRings_; ++k)
    {
      const double angle = 0.5 * EIGEN_PI * k / halfRings_;
      const bool equator = k == halfRings_; // there once
      this->placeRing(k, 1.0, equator ? 1.0 : std::sin(angle), equator ? 0.0 : std::cos(angle));
      if (!equator)
      {
        this->placeRing(k, -1.0, std::sin(angle), std::cos(angle));
      }
    }
    firstOfRing_[1].push_back(firstOfRing_[0].back());
    for (int k = 0; k < halfRings_; ++k)
    {
      this->addStrip(k);
    }
    return std::sqrt(longestSquared_);
  }

  // With the faces. \pre their outline is ring 0.
  TriangleMesh addFaces(const PlateFace& face)
  {
    mesh_.triangles.reserve(mesh_.triangles.size() + 2 * face.triangles.size());
    mesh_.points.reserve(mesh_.points.size() + 2 * face.points.size());
    this->addFace(face, false);
    this->addFace(face, true);
    return std::move(mesh_);
  }

private:
  void addFace(const PlateFace& face, bool lower)
  {
    const double side = lower ? -1.0 : 1.0;
    const Vec3 up = plate_.axes.col(2);
    const Vec3 origin = plate_.origin + side * radius_ * up;
    const int outline = sizes_.front();
    const int first = static_cast<int>(mesh_.points.size());
    for (std::size_t k = static_cast<std::size_t>(outline); k < face.points.size(); ++k)
    {
      mesh_.points.push_back(origin + plate_.axes.leftCols<2>() * face.points[k]);
    }
    mesh_.normals.resize(mesh_.points.size(), side * up);
    const auto idOf = [&](int p)
    { return p < outline ? this->id(0, p, lower) : first + p - outline; };
    for (const auto& [a, b, c] : face.triangles)
    {
      mesh_.triangles.push_back(
        lower ? Triangle{ idOf(a), idOf(c), idOf(b) } : Triangle{ idOf(a), idOf(b), idOf(c) });
    }
  }

  void placeRing(int ring, double side, double across, double up)
  {
    firstOfRing_[side < 0.0].push_back(static_cast<int>(mesh_.points.size()));
    const Vec3 axis = side * up * plate_.axes.col(2);
    const Vec3 origin = plate_.origin + radius_ * axis;
    for (const auto& chain : rings_[static_cast<std::size_t>(ring)])
    {
      for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      {
        const PlateRim::Point& p = chain[k];
        const Vec2 place = p.foot + radius_ * across * p.outward;
        Vec3 normal = plate_.axes.leftCols<2>() * (across * p.normal) + axis;
        if (k == 0) // only there is a mitre
        {
          normal.normalize();
        }
        mesh_.points.push_back(origin + plate_.axes.leftCols<2>() * place);
        mesh_.normals.push_back(normal);
      }
    }
  }

  // Between ring k and the next, above and below: advancing on the ring whose next edge has its
  // middle first, where arcs are as long on both rings as on the wider one.
  void addStrip(int k)
  {
    const PlateRim::Ring& inner = rings_[static_cast<std::size_t>(k)];
    const PlateRim::Ring& outer = rings_[static_cast<std::size_t>(k) + 1];
    const double reach = radius_ * std::sin(0.5 * EIGEN_PI * (k + 1) / halfRings_);
    int a = 0;
    int b = 0;
    for (std::size_t chain = 0; chain < inner.size(); ++chain)
    {
      findKeys(inner[chain], reach, innerKeys_);
      findKeys(outer[chain], reach, outerKeys_);
      const double total = std::max(innerKeys_.back(), outerKeys_.back());
      std::size_t i = 0;
      std::size_t j = 0;
      while (i + 1 < innerKeys_.size() || j + 1 < outerKeys_.size())
      {
        bool onInner = j + 1 == outerKeys_.size();
        if (!onInner && i + 1 < innerKeys_.size())
        {
          const double middle = innerKeys_[i] + innerKeys_[i + 1];
          const double difference = middle - outerKeys_[j] - outerKeys_[j + 1];
          const bool even = std::abs(difference) <= 1e-9 * total;
          onInner = even ? middle < total : difference < 0.0;
        }
        if (onInner)
        {
          const int next = this->after(k, a);
          this->addBoth(k, a, k + 1, b, k, next);
          a = next;
          ++i;
        }
        else
        {
          const int next = this->after(k + 1, b);
          this->addBoth(k, a, k + 1, b, k + 1, next);
          b = next;
          ++j;
        }
      }
    }
  }

  static void findKeys(
    const std::vector<PlateRim::Point>& chain, double reach, std::vector<double>& keys)
  {
    keys.clear();
    for (const PlateRim::Point& p : chain)
    {
      keys.push_back(p.along + reach * p.angle);
    }
  }

  int after(int ring, int point) const
  {
    return point + 1 == sizes_[static_cast<std::size_t>(ring)] ? 0 : point + 1;
  }

  int id(int ring, int p, bool lower) const
  {
    return firstOfRing_[lower][static_cast<std::size_t>(ring)] + p;
  }

  // From b in the outer ring to a in the inner one, to c in either.
  void addBoth(int ringA, int a, int ringB, int b, int ringC, int c)
  {
    const Triangle upper = { id(ringA, a, false), id(ringB, b, false), id(ringC, c, false) };
    mesh_.triangles.push_back(upper);
    mesh_.triangles.push_back({ id(ringA, a, true), id(ringC, c, true), id(ringB, b, true) });
    // The edge from a to b is that of the triangle before.
    const Vec3& apex = mesh_.points[static_cast<std::size_t>(upper[2])];
    for (const int other : { upper[0], upper[1] })
    {
      longestSquared_ = std::max(
        longestSquared_, (mesh_.points[static_cast<std::size_t>(other)] - apex).squaredNorm());
    }
  }

  const PlateShape& plate_;
  double radius_;
  std::vector<PlateRim::Ring> rings_; // from the outline, ring 0, to the equator
  int halfRings_;
  std::vector<int> sizes_;          // of the rings
  std::vector<int> firstOfRing_[2]; // above and below; ring 0 is the outline
  std::vector<double> innerKeys_, outerKeys_;
  double longestSquared_ = 0.0;
  TriangleMesh mesh_;
};

std::vector<PlateRim::Ring> ringsOf(
  const PlateRim& rim, const std::vector<int>& counts, double radius, double spacing)
{
  const int half = std::max(1, static_cast<int>(std::ceil(0.5 * EIGEN_PI * radius / spacing)));
  std::vector<PlateRim::Ring> rings = { rim.outline(counts) };
  for (int k = 1; k <= half; ++k)
  {
    rings.push_back(rim.curve(radius * std::sin(0.5 * EIGEN_PI * k / half), spacing));
  }
  return rings;
}

} // namespace

std::optional<TriangleMesh> meshPlate(const PlateShape& plate, double radius, double edgeLength)
{
  std::vector<Vec2> corners;
  for (const PlateShape::Side& side : plate.sides)
  {
    corners.emplace_back(side.x, side.y);
  }
  const PlateRim rim(corners);
  const double area = 2.0 * areaOf(corners) + EIGEN_PI * radius * (rim.length() + 4.0 * radius);
  requireModestCount(
    area / (0.2 * edgeLength * edgeLength) + 4.0 * rim.length() / edgeLength, edgeLength);
  if (!rim.isSimple(radius))
  {
    return std::nullopt;
  }
  // Right-angled cells on the rim, as long as wide.
  for (double spacing = edgeLength / std::sqrt(2.0); spacing > 0.3 * edgeLength;)
  {
    const std::vector<int> counts = sideCounts(corners, spacing);
    PlateMesher mesher(plate, radius, ringsOf(rim, counts, radius, spacing));
    double longest = mesher.makeRim();
    if (longest <= edgeLength)
    {
      const PlateFace face = meshFace(corners, counts, spacing, edgeLength);
      longest = face.longest;
      if (longest <= edgeLength)
      {
        return mesher.addFaces(face);
      }
    }
    spacing *= std::min(0.985, 0.99 * edgeLength / longest);
  }
  return std::nullopt;
}

} // namespace hybridtree
