// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/KeptReconstruction.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

bool same(const ConvectionOptions& a, const ConvectionOptions& b)
{
  return a.openPockets == b.openPockets && a.pocketFactor == b.pocketFactor &&
    a.maxMemory == b.maxMemory;
}

} // namespace

ReconstructedSurface KeptReconstruction::update(const std::vector<Vec3>& points,
  const LevelOfDetail& detail, const ConvectionOptions& options, const Progress& progress)
{
  std::unique_ptr<DynamicReconstruction> used = std::exchange(kept_, nullptr);
  const ProgressPart first(progress, 0.0, 0.05);
  if (!used || !same(options, options_) || !this->begins(points))
  {
    used.reset();
    used = std::make_unique<DynamicReconstruction>(points, options, first);
  }
  else if (points.size() > points_.size())
  {
    used->add(
      { points.begin() + static_cast<std::ptrdiff_t>(points_.size()), points.end() }, first);
  }
  points_ = points;
  options_ = options;
  ReconstructedSurface surface = used->update(detail, ProgressPart(progress, 0.05, 1.0));
  kept_ = std::move(used);
  return surface;
}

void KeptReconstruction::clear()
{
  *this = KeptReconstruction();
}

// Whether the points are those of the last time, with others after them at most.
bool KeptReconstruction::begins(const std::vector<Vec3>& points) const
{
  return points.size() >= points_.size() &&
    std::equal(points_.begin(), points_.end(), points.begin());
}

} // namespace hybridtree
