// SPDX-License-Identifier: BSD-3-Clause
// How DynamicReconstruction adds points to its surface.
#include "reconstruction/DynamicReconstruction.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

// How often convection may start anew for points that could not be taken up.
constexpr int kRestarts = 3;
// It does for more than this share of all: fewer are reached from the surface as it is.
constexpr double kFewFar = 0.002;
// How often points that were refused are tried again, where others have been placed since.
constexpr int kTries = 6;
// How many steps between two looks at whether to go on.
constexpr std::size_t kBreath = 64;
// How often all points that are too far are tried.
constexpr int kMostRounds = 10;

} // namespace

void DynamicReconstruction::refine(const Phase& phase, const Progress& progress)
{
  state_->near.forgive();
  std::vector<std::int32_t> triangles = state_->surface.surface();
  int tries = 0;
  while (this->refineOnce(phase, triangles, progress) && this->vertexCount() < phase.vertices &&
    ++tries < kTries)
  {
    triangles.clear(); // all others have been seen to
    for (const std::int32_t point : state_->near.forgive())
    {
      triangles.push_back(state_->near.triangle(point));
    }
  }
  // What was refused may be near to triangles that it was not measured against.
  if (phase.tolerance > 0.0)
  {
    state_->near.measure(this->farPoints(phase), state_->surface, progress);
  }
}

// In rounds, each of the farthest points of these triangles and of those that replace them.
// \returns whether any was refused, and others placed.
bool DynamicReconstruction::refineOnce(
  const Phase& phase, const std::vector<std::int32_t>& triangles, const Progress& progress)
{
  candidates_.clear();
  waiting_ = {};
  this->offerAll(phase, triangles);
  alone_.placed = alone_.refused = false;
  std::size_t step = 0;
  for (std::vector<std::int32_t> round = this->nextRound(phase);
       !round.empty() && this->vertexCount() < phase.vertices; round = this->nextRound(phase))
  {
    step += round.size();
    progress.report(1.0 - 1.0 / (1.0 + 1e-4 * double(step)));
    round = this->placeBySlabs(phase, std::move(round), progress);
    for (std::size_t k = 0; k < round.size(); ++k)
    {
      if (k % kBreath == 0)
      {
        progress.check();
      }
      if (this->vertexCount() < phase.vertices && this->isWanted(phase, round[k]))
      {
        this->place(phase, round[k]);
      }
    }
  }
  this->dismissHelpers();
  return alone_.placed && alone_.refused;
}

bool DynamicReconstruction::isWanted(const Phase& phase, std::int32_t point) const
{
  return !state_->near.refused(point) && phase.wants(points_[point], state_->near.distance(point));
}

void DynamicReconstruction::offerAll(const Phase& phase, const std::vector<std::int32_t>& triangles)
{
  constexpr std::size_t kGrain = 4096;
  std::vector<Candidate> farthest(triangles.size());
  parallelFor(triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        farthest[k] = this->farthestOf(phase, triangles[k]);
      }
    });
  for (const Candidate& candidate : farthest)
  {
    this->offer(candidate);
  }
}

// Of the candidates the farthest: those more than half as far as the farthest of all, but no more
// than half of what is wanted. In the order of the points, which is one in space: to visit places
// at random would take twice as long.
std::vector<std::int32_t> DynamicReconstruction::nextRound(const Phase& phase)
{
  constexpr double kNear = 0.5;
  const std::size_t wanted = phase.vertices - std::min(phase.vertices, this->vertexCount());
  double farthest = 0.0;
  std::vector<std::int32_t> round;
  while (!waiting_.empty() && round.size() <= wanted / 2)
  {
    const std::int32_t number = waiting_.pop();
    const Candidate& candidate = candidates_[number];
    if (state_->near.refused(candidate.point) ||
      state_->near.distance(candidate.point) != candidate.distance)
    {
      continue;
    }
    farthest = std::max(farthest, candidate.distance);
    if (candidate.distance <= kNear * farthest)
    {
      waiting_.push(static_cast<float>(candidate.distance), number);
      break;
    }
    round.push_back(candidate.point);
  }
  std::sort(round.begin(), round.end());
  round.erase(std::unique(round.begin(), round.end()), round.end());
  return round;
}

// \returns whether it is no longer too far.
bool DynamicReconstruction::place(const Phase& phase, std::int32_t point)
{
  const bool placed = this->place(alone_, phase, point);
  this->gather(alone_);
  return placed;
}

void DynamicReconstruction::offer(const Candidate& candidate)
{
  if (candidate.point >= 0)
  {
    waiting_.push(
      static_cast<float>(candidate.distance), static_cast<std::int32_t>(candidates_.size()));
    candidates_.push_back(candidate);
  }
}

// Its point is -1 if none is wanted.
DynamicReconstruction::Candidate DynamicReconstruction::farthestOf(
  const Phase& phase, std::int32_t triangle) const
{
  Candidate farthest{ 0.0, -1 };
  state_->near.forEach(triangle,
    [&](std::int32_t point)
    {
      const Candidate candidate{ state_->near.distance(point), point };
      if (this->isWanted(phase, point) && (farthest.point < 0 || candidate < farthest))
      {
        farthest = candidate;
      }
    });
  return farthest;
}

std::vector<std::int32_t> DynamicReconstruction::farPoints(const Phase& phase) const
{
  std::vector<std::int32_t> points;
  for (const std::int32_t point : this->usedPoints())
  {
    if (phase.wants(points_[point], state_->near.distance(point)))
    {
      points.push_back(point);
    }
  }
  return points;
}

// For points that could not be taken up. What comes out is kept if it does much better; with
// another topology, only if that was what most of them missed.
void DynamicReconstruction::convectAgain(const Phase& phase, const Progress& progress)
{
  if (phase.tolerance <= 0.0)
  {
    return;
  }
  std::vector<std::int32_t> far = this->farPoints(phase);
  if (double(far.size()) <= kFewFar * double(measured_))
  {
    return;
  }
  std::size_t fewest = far.size();
  std::ptrdiff_t topology = this->eulerNumber();
  State best = *state_;
  for (int restart = 0; restart < kRestarts && !far.empty(); ++restart)
  {
    this->addSites(far, progress);
    const bool solid = this->convect(progress);
    this->measureAll(progress);
    this->refine(phase, progress);
    far = this->farPoints(phase);
    const std::size_t better = this->eulerNumber() == topology ? 2 : 10;
    if (solid && better * far.size() < fewest)
    {
      best = *state_;
      fewest = far.size();
      topology = this->eulerNumber();
    }
  }
  *state_ = std::move(best);
}

// Step by step. \returns whether it is no longer too far; if not, the steps are taken back.
bool DynamicReconstruction::reach(const Phase& phase, std::int32_t point)
{
  constexpr std::size_t kMostSteps = 64;
  const std::size_t before = state_->surface.stepCount();
  while (!this->place(phase, point))
  {
    if (state_->near.refused(point) || state_->surface.stepCount() > before + kMostSteps)
    {
      while (state_->surface.stepCount() > before)
      {
        this->takeBack();
      }
      state_->near.refuse(point, alone_.scratch);
      state_->near.gather(alone_.scratch);
      return false;
    }
    if (!phase.wants(points_[point], state_->near.distance(point)))
    {
      return true;
    }
  }
  return true;
}

// Points that convection leaves behind, nearest first: each is a step to others behind it. Where
// the surface moves, others may come to be too far, but none for ever: it ends when all are near
// enough, or none of those left can be taken up.
void DynamicReconstruction::reachAll(Phase phase, const Progress& progress)
{
  phase.way = DynamicSurface::Way::Any;
  std::vector<std::int32_t> far = this->farPoints(phase);
  bool reached = true;
  for (int round = 0; reached && !far.empty() && round < kMostRounds; ++round)
  {
    const auto distance = [&](std::int32_t point) { return state_->near.distance(point); };
    std::sort(far.begin(), far.end(),
      [&](std::int32_t a, std::int32_t b)
      { return distance(a) != distance(b) ? distance(a) < distance(b) : a < b; });
    state_->near.forgive();
    reached = false;
    for (std::size_t k = 0; k < far.size(); ++k)
    {
      if (k % 256 == 0)
      {
        progress.check();
      }
      if (phase.wants(points_[far[k]], distance(far[k])))
      {
        reached = this->reach(phase, far[k]) || reached;
      }
    }
    state_->near.measure(this->farPoints(phase), state_->surface, progress);
    far = this->farPoints(phase);
  }
}

// Sees to it that the tolerance holds, if a manifold can.
void DynamicReconstruction::hold(const Phase& phase, const Progress& progress)
{
  if (phase.tolerance <= 0.0)
  {
    return;
  }
  this->reachAll(phase, progress);
  const std::vector<std::int32_t> far = this->farPoints(phase);
  if (far.empty() || phase.region)
  {
    return;
  }
  // Another surface may come around to those that are left.
  State best = *state_;
  const std::ptrdiff_t topology = this->eulerNumber();
  this->addSites(far, progress);
  const bool solid = this->convect(progress);
  this->measureAll(progress);
  this->refine(phase, progress);
  this->reachAll(phase, progress);
  if (!solid || this->eulerNumber() != topology || this->farPoints(phase).size() >= far.size())
  {
    *state_ = std::move(best);
  }
}

} // namespace hybridtree
