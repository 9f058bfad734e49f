// SPDX-License-Identifier: BSD-3-Clause
// How several threads add points to the surface of a DynamicReconstruction at a time.
#include "reconstruction/DynamicReconstruction.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace hybridtree
{

// Each with a slab of space in which as many of the points are.
void DynamicReconstruction::callHelpers(const std::vector<std::int32_t>& points, int side)
{
  this->dismissHelpers();
  std::vector<Vec3> places(points.size());
  std::transform(points.begin(), points.end(), places.begin(),
    [&](std::int32_t point) { return points_[point]; });
  std::vector<DynamicSurface::Hand> hands = state_->surface.part(places, side);
  helpers_.resize(hands.size());
  for (std::size_t k = 0; k < hands.size(); ++k)
  {
    helpers_[k].hand = std::move(hands[k]);
  }
}

void DynamicReconstruction::dismissHelpers()
{
  if (helpers_.empty())
  {
    return;
  }
  std::vector<DynamicSurface::Hand> hands(helpers_.size());
  std::transform(helpers_.begin(), helpers_.end(), hands.begin(),
    [](Helper& helper) { return std::move(helper.hand); });
  state_->surface.join(hands);
  helpers_.clear();
}

// Places what can be by several threads. Points near the borders of slabs across one side are
// mostly far from those across another. \returns the others, in the same order.
std::vector<std::int32_t> DynamicReconstruction::placeBySlabs(
  const Phase& phase, std::vector<std::int32_t> round, const Progress& progress)
{
  constexpr std::size_t kMany = 1024; // worth new slabs
  constexpr std::size_t kSome = 32;
  for (const int side : { 0, 1 })
  {
    if (round.size() >= (side == 0 ? kMany : kMany / 2) ||
      (helpers_.empty() && round.size() >= kSome))
    {
      this->callHelpers(round, side);
    }
    else if (side == 1 || round.size() < kSome)
    {
      return round;
    }
    round = this->placeTogether(phase, round, progress);
  }
  return round;
}

// \returns those that none of the helpers could place alone, in the same order.
std::vector<std::int32_t> DynamicReconstruction::placeTogether(
  const Phase& phase, const std::vector<std::int32_t>& round, const Progress& progress)
{
  DynamicSurface& surface = state_->surface;
  std::vector<std::int32_t> left;
  for (const std::int32_t point : round)
  {
    const std::int32_t hand = surface.handOf(state_->near.triangle(point));
    (hand >= 0 ? helpers_[hand].points : left).push_back(point);
  }
  for (Helper& helper : helpers_)
  {
    surface.provide(helper.hand, helper.points.size());
  }
  state_->pointOfSite.resize(surface.sites().size(), -1);
  state_->near.reserve(surface);
  parallelFor(helpers_.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        this->placeAll(helpers_[k], phase, progress);
      }
    });
  for (Helper& helper : helpers_)
  {
    left.insert(left.end(), helper.left.begin(), helper.left.end());
    surface.gather(helper.hand);
    this->gather(helper);
  }
  std::sort(left.begin(), left.end());
  return left;
}

void DynamicReconstruction::placeAll(Helper& helper, const Phase& phase, const Progress& progress)
{
  constexpr std::size_t kBreath = 64;
  for (std::size_t k = 0; k < helper.points.size(); ++k)
  {
    if (k % kBreath == 0)
    {
      progress.check();
    }
    if (this->isWanted(phase, helper.points[k]))
    {
      this->place(helper, phase, helper.points[k]);
    }
  }
}

// \returns whether it is no longer too far.
bool DynamicReconstruction::place(Helper& helper, const Phase& phase, std::int32_t point)
{
  DynamicSurface& surface = state_->surface;
  TrianglePoints& near = state_->near;
  const std::int32_t triangle = near.triangle(point);
  const double distance = near.distance(point);
  const std::int32_t other = near.neighbor(point);
  const auto offer = [&](std::int32_t number)
  {
    const Candidate candidate = this->farthestOf(phase, number);
    if (candidate.point >= 0)
    {
      helper.candidates.push_back(candidate);
    }
  };
  const auto placed = [&]
  {
    helper.placed = true;
    helper.reach.push_back(distance);
    this->follow(helper);
    const std::vector<std::int32_t>& added = this->handOf(helper).lastChange().added;
    std::for_each(added.begin(), added.end(), offer);
    if (other >= 0)
    {
      offer(near.triangle(other));
    }
    return true;
  };
  const DynamicSurface::Hand& hand = this->handOf(helper);
  switch (&helper == &alone_
      ? surface.place(points_[point], triangle, phase.tolerance, phase.way)
      : surface.place(helper.hand, points_[point], triangle, phase.tolerance))
  {
    case DynamicSurface::Outcome::Prepared:
      placed();
      return phase.way == DynamicSurface::Way::Convected && this->place(helper, phase, point);
    case DynamicSurface::Outcome::Placed:
      if (&helper == &alone_)
      {
        state_->pointOfSite.push_back(-1);
      }
      state_->pointOfSite[hand.lastSite()] = point;
      [[fallthrough]];
    case DynamicSurface::Outcome::Surfaced:
      near.move(point, hand.lastChange().removed.front(), 0.0);
      return placed();
    case DynamicSurface::Outcome::Near:
    case DynamicSurface::Outcome::Coincides:
      helper.placed = true;
      near.move(point, hand.nearTriangle(), hand.nearDistance());
      break;
    case DynamicSurface::Outcome::Refused:
      helper.refused = true;
      near.refuse(point, helper.scratch);
      offer(triangle);
      return false;
    case DynamicSurface::Outcome::Left:
      helper.left.push_back(point);
      return false;
  }
  offer(triangle);
  return true;
}

const DynamicSurface::Hand& DynamicReconstruction::handOf(const Helper& helper) const
{
  return &helper == &alone_ ? state_->surface.hand() : helper.hand;
}

// After a step of the helper's.
void DynamicReconstruction::follow(Helper& helper)
{
  const DynamicSurface::Change& change = this->handOf(helper).lastChange();
  helper.moreTriangles +=
    std::ptrdiff_t(change.added.size()) - std::ptrdiff_t(change.removed.size());
  state_->near.follow(state_->surface, change, helper.scratch);
}

// What a helper has done, after what was done before.
void DynamicReconstruction::gather(Helper& helper)
{
  state_->moreTriangles += std::exchange(helper.moreTriangles, 0);
  state_->reach.insert(state_->reach.end(), helper.reach.begin(), helper.reach.end());
  state_->near.gather(helper.scratch);
  for (const Candidate& candidate : helper.candidates)
  {
    this->offer(candidate);
  }
  alone_.placed = alone_.placed || helper.placed;
  alone_.refused = alone_.refused || helper.refused;
  helper.points.clear();
  helper.left.clear();
  helper.reach.clear();
  helper.candidates.clear();
}

} // namespace hybridtree
