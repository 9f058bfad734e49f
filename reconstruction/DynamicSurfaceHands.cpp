// SPDX-License-Identifier: BSD-3-Clause
// How several threads place points on a DynamicSurface at a time.
#include "reconstruction/DynamicSurface.h"

#include <utility>

namespace hybridtree
{

std::vector<DynamicSurface::Hand> DynamicSurface::part(const std::vector<Vec3>& points, int side)
{
  std::vector<Delaunay::Worker> workers = delaunay_.part(points, side);
  std::vector<Hand> hands(workers.size());
  for (std::size_t k = 0; k < workers.size(); ++k)
  {
    hands[k].worker_ = std::move(workers[k]);
    hands[k].alone_ = false;
  }
  return hands;
}

void DynamicSurface::provide(Hand& hand, std::size_t points)
{
  hand.nextSite_ = delaunay_.provide(hand.worker_, points);
  inside_.resize(delaunay_.cellCount(), 0);
}

void DynamicSurface::gather(Hand& hand)
{
  own_.history_.append(hand.history_);
  hand.history_ = {};
}

void DynamicSurface::History::append(const History& later)
{
  for (Step step : later.steps)
  {
    step.replaced += replaced.size();
    step.removed += removed.size();
    step.renamed += renamed.size();
    steps.push_back(step);
  }
  const auto put = [](auto& list, const auto& more)
  { list.insert(list.end(), more.begin(), more.end()); };
  put(replaced, later.replaced);
  put(replacedInside, later.replacedInside);
  put(removed, later.removed);
  put(renamed, later.renamed);
}

void DynamicSurface::join(std::vector<Hand>& hands)
{
  std::vector<Delaunay::Worker> workers(hands.size());
  for (std::size_t k = 0; k < hands.size(); ++k)
  {
    workers[k] = std::move(hands[k].worker_);
  }
  delaunay_.join(workers);
  hands.clear();
}

} // namespace hybridtree
