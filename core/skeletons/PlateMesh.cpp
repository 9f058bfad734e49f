// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateMesh.h"

#include "core/skeletons/LongestEdge.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/PlateFace.h"
#include "core/skeletons/PlateRim.h"

#include <algorithm>
#include <cmath>

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
  PlateMesher(const PlateShape& plate, const PlateRim& rim, const std::vector<Vec2>& corners,
    double radius, double edgeLength, double spacing)
    : plate_(plate), radius_(radius)
  {
    const std::vector<int> counts = sideCounts(corners, spacing);
    face_ = meshFace(corners, counts, spacing, edgeLength);
    halfRings_ = std::max(1, static_cast<int>(std::ceil(0.5 * EIGEN_PI * radius / spacing)));
    rings_.push_back(rim.outline(counts));
    for (int k = 1; k <= halfRings_; ++k)
    {
      rings_.push_back(rim.curve(radius * this->cosine(k), spacing));
    }
  }

  TriangleMesh make()
  {
    this->placePoints();
    for (int k = 0; k < halfRings_; ++k)
    {
      this->addStrip(k);
    }
    this->addFaces();
    return std::move(mesh_);
  }

private:
  double cosine(int ring) const { return std::sin(0.5 * EIGEN_PI * ring / halfRings_); }

  void addPoint(const Vec2& place, double height, const Vec2& across, double up)
  {
    mesh_.points.push_back(
      plate_.origin + plate_.axes * Vec3(place.x(), place.y(), radius_ * height));
    mesh_.normals.push_back(plate_.axes * Vec3(across.x(), across.y(), up).normalized());
  }

  static int sizeOf(const PlateRim::Ring& ring)
  {
    std::size_t size = 0;
    for (const auto& chain : ring)
    {
      size += chain.size() - 1;
    }
    return static_cast<int>(size);
  }

  void placePoints()
  {
    for (const double side : { 1.0, -1.0 })
    {
      firstOfFace_[side < 0.0] = static_cast<int>(mesh_.points.size());
      for (const Vec2& p : face_.points)
      {
        this->addPoint(p, side, Vec2::Zero(), side);
      }
    }
    for (int k = 1; k <= halfRings_; ++k)
    {
      const double across = k == halfRings_ ? 1.0 : this->cosine(k);
      const double up = k == halfRings_ ? 0.0 : std::cos(0.5 * EIGEN_PI * k / halfRings_);
      for (const double side : { 1.0, -1.0 })
      {
        if (k == halfRings_ && side < 0.0)
        {
          break; // the equator is there once
        }
        firstOfRing_[side < 0.0].push_back(static_cast<int>(mesh_.points.size()));
        for (const auto& chain : rings_[static_cast<std::size_t>(k)])
        {
          for (std::size_t p = 0; p + 1 < chain.size(); ++p)
          {
            this->addPoint(chain[p].foot + radius_ * across * chain[p].outward, side * up,
              across * chain[p].normal, side * up);
          }
        }
      }
    }
    firstOfRing_[1].push_back(firstOfRing_[0].back());
  }

  int firstOf(int ring, bool lower) const
  {
    return ring == 0 ? firstOfFace_[lower]
                     : firstOfRing_[lower][static_cast<std::size_t>(ring) - 1];
  }

  // Between ring k and the next, above and below: advancing on the ring whose next edge has its
  // middle first, where arcs are as long on both rings as on the wider one.
  void addStrip(int k)
  {
    const PlateRim::Ring& inner = rings_[static_cast<std::size_t>(k)];
    const PlateRim::Ring& outer = rings_[static_cast<std::size_t>(k) + 1];
    const double reach = radius_ * this->cosine(k + 1);
    const auto key = [reach](const PlateRim::Point& p) { return p.along + reach * p.angle; };
    const int innerSize = sizeOf(inner);
    const int outerSize = sizeOf(outer);
    int a = 0;
    int b = 0;
    for (std::size_t chain = 0; chain < inner.size(); ++chain)
    {
      const auto& p = inner[chain];
      const auto& q = outer[chain];
      const double total = std::max(key(p.back()), key(q.back()));
      std::size_t i = 0;
      std::size_t j = 0;
      while (i + 1 < p.size() || j + 1 < q.size())
      {
        bool onInner = j + 1 == q.size();
        if (!onInner && i + 1 < p.size())
        {
          const double difference = key(p[i]) + key(p[i + 1]) - key(q[j]) - key(q[j + 1]);
          const bool even = std::abs(difference) <= 1e-9 * total;
          onInner = even ? key(p[i]) + key(p[i + 1]) < total : difference < 0.0;
        }
        const int pa = (a + static_cast<int>(i)) % innerSize;
        const int qb = (b + static_cast<int>(j)) % outerSize;
        if (onInner)
        {
          this->addBoth(k, pa, k + 1, qb, k, (pa + 1) % innerSize);
          ++i;
        }
        else
        {
          this->addBoth(k, pa, k + 1, qb, k + 1, (qb + 1) % outerSize);
          ++j;
        }
      }
      a += static_cast<int>(p.size()) - 1;
      b += static_cast<int>(q.size()) - 1;
    }
  }

  void addBoth(int ringA, int a, int ringB, int b, int ringC, int c)
  {
    const auto id = [&](int ring, int p, bool lower) { return this->firstOf(ring, lower) + p; };
    mesh_.triangles.push_back({ id(ringA, a, false), id(ringB, b, false), id(ringC, c, false) });
    mesh_.triangles.push_back({ id(ringA, a, true), id(ringC, c, true), id(ringB, b, true) });
  }

  void addFaces()
  {
    for (const auto& [a, b, c] : face_.triangles)
    {
      const int up = firstOfFace_[0];
      const int low = firstOfFace_[1];
      mesh_.triangles.push_back({ up + a, up + b, up + c });
      mesh_.triangles.push_back({ low + a, low + c, low + b });
    }
  }

  const PlateShape& plate_;
  double radius_;
  PlateFace face_;
  int halfRings_;
  std::vector<PlateRim::Ring> rings_; // from the outline, ring 0, to the equator
  int firstOfFace_[2];
  std::vector<int> firstOfRing_[2]; // of rings 1, 2, ...; above and below
  TriangleMesh mesh_;
};

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
  requireModestCount(area / (0.2 * edgeLength * edgeLength), edgeLength);
  if (!rim.isSimple(radius))
  {
    return std::nullopt;
  }
  // Right-angled cells on the rim, as long as wide.
  for (double spacing = edgeLength / std::sqrt(2.0); spacing > 0.3 * edgeLength;)
  {
    TriangleMesh mesh = PlateMesher(plate, rim, corners, radius, edgeLength, spacing).make();
    const double longest = longestEdge(mesh);
    if (longest <= edgeLength)
    {
      return mesh;
    }
    spacing *= std::min(0.99, edgeLength / longest);
  }
  return std::nullopt;
}

} // namespace hybridtree
