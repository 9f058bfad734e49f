// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RemeshSteps.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Index = RemeshSurface::Index;

constexpr double kFlatEnough = 0.9; // cosine of the angle across an edge that may be flipped
constexpr double kBestShape = 0.5;
constexpr double kWorthIt = 0.02; // gain in shape for which an edge is flipped

/// As far as the triangles and their places tell.
bool isBetterFlipped(const RemeshSurface& surface, Index h)
{
  const MeshLinks& links = surface.links();
  const Index twin = links.twin(h);
  if (twin == MeshLinks::kNone || surface.leaf(h) != surface.leaf(twin))
  {
    return false;
  }
  const double before = std::max(surface.shape(static_cast<std::size_t>(h / 3)),
    surface.shape(static_cast<std::size_t>(twin / 3)));
  if (before - kWorthIt < kBestShape)
  {
    return false;
  }
  const Vec3& a = surface.point(links.from(h));
  const Vec3& b = surface.point(links.to(h));
  const Vec3& c = surface.point(links.opposite(h));
  const Vec3& d = surface.point(links.opposite(twin));
  if (std::max(shapeOf(d, b, c), shapeOf(c, a, d)) > before - kWorthIt ||
    (c - d).squaredNorm() > std::max(surface.longSquared(), (a - b).squaredNorm()))
  {
    return false;
  }
  const Vec3 first = normalOf(a, b, c);
  const Vec3 second = normalOf(b, a, d);
  const bool flat =
    before > kSliver || first.dot(second) >= kFlatEnough * first.norm() * second.norm();
  const Vec3 both = first + second;
  return flat && !turnsTooFar(both, normalOf(d, b, c)) && !turnsTooFar(both, normalOf(c, a, d));
}

bool flipOneOf(RemeshSurface& surface, std::size_t t)
{
  for (auto h = static_cast<Index>(3 * t); h < static_cast<Index>(3 * t + 3); ++h)
  {
    if (!isBetterFlipped(surface, h))
    {
      continue;
    }
    if (surface.links().canFlip(h))
    {
      surface.flip(h);
      return true;
    }
    surface.toFlip().insert(t); // what is in the way may go, and that need not be near
  }
  return false;
}

} // namespace

bool flipEdges(RemeshSurface& surface)
{
  bool any = false;
  IndexSet& set = surface.toFlip();
  std::size_t step = 0;
  for (std::size_t t = set.next(0); t < set.size(); t = set.next(t + 1))
  {
    surface.lookForStop(step++);
    set.erase(t);
    any = flipOneOf(surface, t) || any;
  }
  return any;
}

} // namespace hybridtree
