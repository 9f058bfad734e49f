// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateMesh.h"

#include "core/mesh/AddTriangle.h"
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
  PlateMesher(const PlateShape& plate, double radius, std::vector<PlateRim::Ring> rings)
    : plate_(plate), radius_(radius), rings_(std::move(rings))
  {
  }

  // The rim. Returns the length of its longest edge across from ring to ring.
  // \param inFaces about how many points the faces will have.
  double makeRim(double inFaces)
  {
    auto count = static_cast<std::size_t>(inFaces);
    for (const PlateRim::Ring& ring : rings_)
    {
      int size = 0;
      for (const PlateRim::Chain& chain : ring)
      {
        size += static_cast<int>(chain.middles.size());
      }
      ids_.push_back({ 0, 0, size });
      count += 2 * static_cast<std::size_t>(size);
    }
    mesh_.points.reserve(count);
    mesh_.normals.reserve(count);
    mesh_.triangles.reserve(2 * count);
    for (std::size_t k = 0; k < rings_.size(); ++k)
    {
      this->placeRing(k);
    }
    for (std::size_t k = 0; k + 1 < rings_.size(); ++k)
    {
      this->addStrip(k);
    }
    return std::sqrt(longestSquared_);
  }

  // With the faces. \pre their outline is ring 0.
  TriangleMesh addFaces(const PlateFace& face)
  {
    const Ids outline = ids_.front();
    const int inner = static_cast<int>(face.points.size()) - outline.size;
    const int above = static_cast<int>(mesh_.points.size());
    const int below = above + inner;
    const Vec3 up = plate_.axes.col(2);
    mesh_.normals.resize(static_cast<std::size_t>(below), up);
    mesh_.normals.resize(static_cast<std::size_t>(below + inner), -up);
    for (const double side : { radius_, -radius_ })
    {
      for (std::size_t k = static_cast<std::size_t>(outline.size); k < face.points.size(); ++k)
      {
        mesh_.points.push_back(this->placeOf(face.points[k]) + side * up);
      }
    }
    const auto upper = [&](int p)
    { return p < outline.size ? outline.above + p : above + p - outline.size; };
    const auto lower = [&](int p)
    { return p < outline.size ? outline.below + p : below + p - outline.size; };
    for (const auto& [a, b, c] : face.triangles)
    {
      addTriangle(mesh_.triangles, upper(a), upper(b), upper(c));
      addTriangle(mesh_.triangles, lower(a), lower(c), lower(b));
    }
    return std::move(mesh_);
  }

private:
  // The first points of a ring in the mesh, and how many there are. The equator is there once.
  struct Ids
  {
    int above, below;
    int size;

    int after(int point) const { return point + 1 == size ? 0 : point + 1; }
  };

  // In the plane of the plate.
  Vec3 placeOf(const Vec2& p) const { return plate_.origin + plate_.axes.leftCols<2>() * p; }

  void placeRing(std::size_t ring)
  {
    const bool equator = ring + 1 == rings_.size();
    const double angle = 0.5 * EIGEN_PI * double(ring) / double(rings_.size() - 1);
    const double across = equator ? 1.0 : std::sin(angle);
    const Vec3 lift = (equator ? 0.0 : std::cos(angle)) * plate_.axes.col(2);
    Ids& ids = ids_[ring];
    auto above = mesh_.points.size();
    auto below = above + static_cast<std::size_t>(equator ? 0 : ids.size);
    ids.above = static_cast<int>(above);
    ids.below = static_cast<int>(below);
    mesh_.points.resize(below + static_cast<std::size_t>(ids.size));
    mesh_.normals.resize(mesh_.points.size());
    for (const PlateRim::Chain& chain : rings_[ring])
    {
      for (std::size_t k = 0; k < chain.middles.size(); ++k, ++above, ++below)
      {
        const PlateRim::Point& p = chain.points[k];
        const Vec3 place = this->placeOf(p.foot + radius_ * across * p.outward);
        const Vec3 normal = plate_.axes.leftCols<2>() * (across * p.normal);
        // Only at the first is there a mitre.
        const double length = k == 0 ? (normal + lift).norm() : 1.0;
        mesh_.points[below] = place - radius_ * lift;
        mesh_.points[above] = place + radius_ * lift;
        mesh_.normals[below] = (normal - lift) / length;
        mesh_.normals[above] = (normal + lift) / length;
      }
    }
  }

  // Between ring k and the next, above and below: advancing on the ring whose next edge has its
  // middle first, where arcs are as long on both rings as on the wider one.
  void addStrip(std::size_t k)
  {
    const PlateRim::Ring& inner = rings_[k];
    const PlateRim::Ring& outer = rings_[k + 1];
    const double reach =
      radius_ * std::sin(0.5 * EIGEN_PI * double(k + 1) / double(ids_.size() - 1));
    const auto keyOf = [reach](const PlateRim::Place& place)
    { return place.along + reach * place.angle; };
    int a = 0;
    int b = 0;
    for (std::size_t chain = 0; chain < inner.size(); ++chain)
    {
      const std::vector<PlateRim::Place>& onInner = inner[chain].middles;
      const std::vector<PlateRim::Place>& onOuter = outer[chain].middles;
      const double total = std::max(keyOf(inner[chain].end), keyOf(outer[chain].end));
      std::size_t i = 0;
      std::size_t j = 0;
      while (i < onInner.size() || j < onOuter.size())
      {
        bool isInner = j == onOuter.size();
        if (!isInner && i < onInner.size())
        {
          const double key = keyOf(onInner[i]);
          const double difference = key - keyOf(onOuter[j]);
          const bool even = std::abs(difference) <= 1e-9 * total;
          isInner = even ? 2.0 * key < total : difference < 0.0;
        }
        this->addStep(ids_[k], ids_[k + 1], isInner, a, b);
        ++(isInner ? i : j);
      }
    }
  }

  // The triangles from the edge between points a and b to the next point of either ring.
  void addStep(const Ids& inner, const Ids& outer, bool isInner, int& a, int& b)
  {
    const Ids& ring = isInner ? inner : outer;
    int& point = isInner ? a : b;
    const int next = ring.after(point);
    addTriangle(mesh_.triangles, inner.above + a, outer.above + b, ring.above + next);
    addTriangle(mesh_.triangles, inner.below + a, ring.below + next, outer.below + b);
    point = next;
    const Vec3& from = mesh_.points[static_cast<std::size_t>(inner.above + a)];
    const Vec3& to = mesh_.points[static_cast<std::size_t>(outer.above + b)];
    longestSquared_ = std::max(longestSquared_, (from - to).squaredNorm());
  }

  const PlateShape& plate_;
  double radius_;
  std::vector<PlateRim::Ring> rings_; // from the outline, ring 0, to the equator
  std::vector<Ids> ids_;
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
  const double inFaces = 2.0 * areaOf(corners);
  const double area = inFaces + EIGEN_PI * radius * (rim.length() + 4.0 * radius);
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
    double longest = mesher.makeRim(1.25 * inFaces / (spacing * spacing));
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
