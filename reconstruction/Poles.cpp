// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Poles.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kGrain = 2048;
// Cosine between the ways to a cell's circumcentre and to its middle, seen from the point.
constexpr double kAgreement = 0.7;
// Cosine between the ways to both poles, one of them turned round; and to the normal.
constexpr double kOpposite = 0.8;

struct Candidate
{
  std::int32_t cell;
  double size; // longest edge, or the diameter of the ball around, in world units
  Vec3 direction;
};

std::array<Vec3, 4> cornersFrom(
  const Tetrahedralization& tetrahedra, std::int32_t cell, std::int32_t vertex)
{
  std::array<Vec3, 4> corners;
  const auto& points = tetrahedra.points();
  std::transform(tetrahedra.cell(cell).begin(), tetrahedra.cell(cell).end(), corners.begin(),
    [&](std::int32_t corner) { return Vec3(points[corner] - points[vertex]); });
  return corners;
}

Vec3 circumcenter(const std::array<Vec3, 4>& p)
{
  const Vec3 a = p[1] - p[0];
  const Vec3 b = p[2] - p[0];
  const Vec3 c = p[3] - p[0];
  const Vec3 bc = b.cross(c);
  return p[0] +
    (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
    (2.0 * a.dot(bc));
}

class PolesOfPoint
{
public:
  PolesOfPoint(const Tetrahedralization& tetrahedra, const FacetSize& sizes, double least)
    : tetrahedra_(tetrahedra), sizes_(sizes), least_(least)
  {
  }

  Poles find(std::int32_t vertex, const Vec3& normal)
  {
    this->collect(vertex);
    Poles poles;
    const bool known = normal != Vec3::Zero();
    const Vec3 unit = normal.stableNormalized();
    const Candidate* up = known ? this->along(unit) : this->largest();
    const Candidate* down =
      up || known ? this->along(known ? Vec3(-unit) : Vec3(-up->direction)) : nullptr;
    poles.up = up ? up->cell : -1;
    poles.down = down ? down->cell : -1;
    poles.strength =
      std::min(up ? up->size : kInfinity, down ? down->size : kInfinity) / sizes_.spacing(vertex);
    return poles;
  }

private:
  void collect(std::int32_t vertex)
  {
    candidates_.clear();
    const double least = least_ * sizes_.spacing(vertex);
    for (const std::int32_t cell : tetrahedra_.star(vertex))
    {
      if (!tetrahedra_.finite(cell))
      {
        candidates_.push_back({ cell, kInfinity, hullNormal(tetrahedra_, cell) });
        continue;
      }
      const double length = sizes_.lengthOfCell(cell);
      if (!(length >= least))
      {
        continue;
      }
      const std::array<Vec3, 4> corners = cornersFrom(tetrahedra_, cell, vertex);
      const Vec3 center = circumcenter(corners);
      const double radius = center.norm();
      const Vec3 middle = corners[0] + corners[1] + corners[2] + corners[3];
      if (center.dot(middle) > kAgreement * radius * middle.norm() && 2.0 * radius >= least)
      {
        candidates_.push_back({ cell, std::min(length, 2.0 * radius), center / radius });
      }
    }
  }

  // The hull's facets around a point together say where the outside is, unless it lies to both
  // sides: then one of them does.
  const Candidate* largest() const
  {
    Vec3 sum = Vec3::Zero();
    const Candidate* best = nullptr;
    double hull = 0.0;
    for (const Candidate& candidate : candidates_)
    {
      best = !best || candidate.size > best->size ? &candidate : best;
      if (std::isinf(candidate.size))
      {
        sum += candidate.direction;
        hull += 1.0;
      }
    }
    if (sum.norm() <= 0.5 * hull)
    {
      return best;
    }
    for (const Candidate& candidate : candidates_)
    {
      const bool nearer = candidate.direction.dot(sum) > best->direction.dot(sum);
      best = std::isinf(candidate.size) && nearer ? &candidate : best;
    }
    return best;
  }

  const Candidate* along(const Vec3& direction) const
  {
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates_)
    {
      if (candidate.direction.dot(direction) > kOpposite && (!best || candidate.size > best->size))
      {
        best = &candidate;
      }
    }
    return best;
  }

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const double least_;
  std::vector<Candidate> candidates_;
};

} // namespace

Vec3 hullNormal(const Tetrahedralization& tetrahedra, std::int32_t infiniteCell)
{
  const int facet = tetrahedra.indexOf(infiniteCell, Tetrahedralization::kInfinite);
  const auto v = tetrahedra.facet(
    tetrahedra.neighbor(infiniteCell, facet), tetrahedra.mirror(infiniteCell, facet));
  const auto& p = tetrahedra.points();
  return (p[v[1]] - p[v[0]]).cross(p[v[2]] - p[v[0]]).stableNormalized();
}

std::vector<Poles> findPoles(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double least, const std::vector<Vec3>* normals, const Progress& progress)
{
  std::vector<Poles> poles(tetrahedra.points().size());
  parallelFor(poles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      PolesOfPoint finder(tetrahedra, sizes, least);
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        const Vec3 normal = normals ? (*normals)[vertex] : Vec3(Vec3::Zero());
        poles[vertex] = finder.find(static_cast<std::int32_t>(vertex), normal);
      }
    });
  return poles;
}

} // namespace hybridtree
