// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RemeshSteps.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Index = RemeshSurface::Index;

constexpr std::uint32_t kNever = 0xffffffffu;

/// By how much the worst shape around the start of h gets better; 0 or less when it may not go.
double gainOf(const RemeshSurface& surface, Index h)
{
  const MeshLinks& links = surface.links();
  const Index from = links.from(h);
  const Index to = links.to(h);
  const Vec3& target = surface.point(to);
  double before = 0.0;
  double after = 0.0;
  Vec3 around = Vec3::Zero();
  links.forEachLeaving(
    from, [&](Index leaving) { around += surface.normal(static_cast<std::size_t>(leaving / 3)); });
  bool allowed = true;
  links.forEachLeaving(from,
    [&](Index leaving)
    {
      const auto t = static_cast<std::size_t>(leaving / 3);
      const Index b = links.to(leaving);
      const Index c = links.opposite(leaving);
      const double shape = surface.shape(t);
      before = std::max(before, shape);
      allowed = allowed && surface.leaf(leaving) == surface.leaf(h);
      if (b == to || c == to || !allowed)
      {
        return;
      }
      const Vec3 turned = normalOf(target, surface.point(b), surface.point(c));
      const Vec3 old = shape > kSliver ? around : surface.normal(t);
      const double length = (surface.point(b) - target).squaredNorm();
      allowed = !turnsTooFar(old, turned) &&
        length <= std::max(surface.longSquared(), surface.squaredLength(leaving));
      after = std::max(after, shapeOf(target, surface.point(b), surface.point(c)));
    });
  return allowed ? before - after : 0.0;
}

/// Towards the end that leaves the better triangles.
bool collapseEdge(RemeshSurface& surface, Index h)
{
  if (!surface.links().canCollapse(h)) // the same for both directions
  {
    return false;
  }
  const Index twin = surface.links().twin(h);
  const double forth = gainOf(surface, h);
  const double back = gainOf(surface, twin);
  if (std::max(forth, back) <= 0.0)
  {
    return false;
  }
  surface.collapse(forth >= back ? h : twin);
  return true;
}

Index shortestOf(const RemeshSurface& surface, std::size_t t)
{
  auto h = static_cast<Index>(3 * t);
  for (Index other = h + 1; other < static_cast<Index>(3 * t + 3); ++other)
  {
    h = surface.squaredLength(other) < surface.squaredLength(h) ? other : h;
  }
  return h;
}

} // namespace

bool ShortEdges::collapse()
{
  bool any = false;
  std::size_t step = 0;
  const IndexSet& bad = surface_.bad();
  refused_.resize(bad.size(), kNever);
  for (std::size_t t = bad.next(0); t < bad.size(); t = bad.next(t + 1))
  {
    surface_.lookForStop(step++);
    any = this->collapse(t) || any;
  }
  return any;
}

bool ShortEdges::collapse(std::size_t t)
{
  const Index h = shortestOf(surface_, t);
  const Index from = surface_.links().from(h);
  const Index to = surface_.links().to(h);
  if (!(surface_.squaredLength(h) < surface_.shortSquared()) || surface_.links().isLocked(from) ||
    surface_.links().isLocked(to))
  {
    return false;
  }
  if (refused_[t] != kNever && surface_.lastEditAt(from) <= refused_[t] &&
    surface_.lastEditAt(to) <= refused_[t])
  {
    return false;
  }
  refused_[t] = surface_.lastEdit();
  return collapseEdge(surface_, h);
}

} // namespace hybridtree
