// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/LevelOfDetail.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/DynamicReconstruction.h"
#include "reconstruction/Holes.h"

namespace hybridtree
{

ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options, const Progress& progress)
{
  checkNormals(points.size(), options);
  DynamicReconstruction reconstruction(points, options, ProgressPart(progress, 0.0, 0.02));
  ReconstructedSurface surface = reconstruction.update(detail, ProgressPart(progress, 0.02, 1.0));
  if (!options.closeHoles)
  {
    openHoles(surface, points, options.holeFactor, progress);
  }
  return surface;
}

} // namespace hybridtree
