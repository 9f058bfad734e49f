// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/KeptReconstruction.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/Holes.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

// Of what the kept state depends on, which holes do not. More normals may have come, with more
// points.
bool same(const ConvectionOptions& now, const ConvectionOptions& before)
{
  return now.openPockets == before.openPockets && now.pocketFactor == before.pocketFactor &&
    now.maxMemory == before.maxMemory && now.normals.empty() == before.normals.empty() &&
    now.normals.size() >= before.normals.size() &&
    std::equal(before.normals.begin(), before.normals.end(), now.normals.begin());
}

} // namespace

ReconstructedSurface KeptReconstruction::update(const std::vector<Vec3>& points,
  const LevelOfDetail& detail, const ConvectionOptions& options, const Progress& progress)
{
  if (points.size() <= detail.vertices)
  {
    return reconstruct(points, options, progress); // nothing to choose from
  }
  checkOptions(detail.vertices, options);
  checkNormals(points.size(), options);
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
  if (!options.closeHoles)
  {
    openHoles(surface, points, options.holeFactor, progress);
  }
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
