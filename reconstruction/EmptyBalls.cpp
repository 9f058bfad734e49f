// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/EmptyBalls.h"

#include "reconstruction/JoinedParts.h"
#include "reconstruction/Poles.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 2048;
// A ball of this many times the extent is a half-space: points of a plane face, as far as double
// can tell. Its centre is rounding, but the side is known: within the hull it would not be empty.
constexpr double kHuge = 1e3;
constexpr double kFlat = 1e-13;

} // namespace

EmptyBalls::EmptyBalls(const Tetrahedralization& tetrahedra, const Progress& progress)
  : tetrahedra_(tetrahedra)
  , middle_(Vec3::Zero())
  , balls_(static_cast<std::size_t>(tetrahedra.cellCount()))
{
  const auto& points = tetrahedra.points();
  Box3 box;
  for (const Vec3& point : points)
  {
    box.extend(point);
    middle_ += point / double(points.size());
  }
  const double huge = kHuge * box.diagonal().norm();
  parallelFor(balls_.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t cell = begin; cell < end; ++cell)
      {
        balls_[cell] = this->ballOf(static_cast<std::int32_t>(cell), huge);
      }
    });
}

EmptyBalls::Ball EmptyBalls::ballOf(std::int32_t cell, double huge) const
{
  if (!tetrahedra_.finite(cell))
  {
    return { hullNormal(tetrahedra_, cell), 0.0 };
  }
  const auto& v = tetrahedra_.cell(cell);
  const auto& p = tetrahedra_.points();
  const Vec3 a = p[v[1]] - p[v[0]];
  const Vec3 b = p[v[2]] - p[v[0]];
  const Vec3 c = p[v[3]] - p[v[0]];
  const Vec3 bc = b.cross(c);
  const Vec3 center =
    (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
    (2.0 * a.dot(bc));
  const double longest = std::sqrt(std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm() }));
  const bool flat = !(std::abs(a.dot(bc)) > kFlat * longest * longest * longest);
  const double radius = center.norm();
  return flat || !(radius < huge) ? this->halfSpace(cell) : Ball{ p[v[0]] + center, radius };
}

EmptyBalls::Ball EmptyBalls::halfSpace(std::int32_t cell) const
{
  const auto& p = tetrahedra_.points();
  Vec3 normal = Vec3::Zero();
  for (int facet = 0; facet < 4; ++facet)
  {
    const auto v = tetrahedra_.facet(cell, facet);
    const Vec3 other = (p[v[1]] - p[v[0]]).cross(p[v[2]] - p[v[0]]);
    normal = other.squaredNorm() > normal.squaredNorm() ? other : normal;
  }
  normal = normal.stableNormalized();
  const bool out = normal.dot(p[tetrahedra_.cell(cell)[0]] - middle_) >= 0.0;
  return { out ? normal : Vec3(-normal), 0.0 };
}

std::vector<SignedLink> linksOfNeighbors(
  const Tetrahedralization& tetrahedra, const EmptyBalls& balls, const Progress& progress)
{
  const auto count = static_cast<std::size_t>(tetrahedra.cellCount());
  return collectInParts<SignedLink>(count, kGrain, progress,
    [&](std::size_t begin, std::size_t end, std::vector<SignedLink>& links)
    {
      for (auto cell = static_cast<std::int32_t>(begin); cell < static_cast<std::int32_t>(end);
           ++cell)
      {
        for (int facet = 0; facet < 4; ++facet)
        {
          const std::int32_t other = tetrahedra.neighbor(cell, facet);
          if (other > cell)
          {
            const std::int32_t first = tetrahedra.facet(cell, facet)[0];
            const std::int32_t corner =
              first == Tetrahedralization::kInfinite ? tetrahedra.facet(cell, facet)[1] : first;
            const double cosine = balls.way(corner, cell).dot(balls.way(corner, other));
            links.push_back({ cell, other, EmptyBalls::weight(cosine) });
          }
        }
      }
    });
}

} // namespace hybridtree
