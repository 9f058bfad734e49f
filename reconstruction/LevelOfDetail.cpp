// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/LevelOfDetail.h"

#include "reconstruction/DynamicReconstruction.h"

namespace hybridtree
{

ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options, const Progress& progress)
{
  DynamicReconstruction reconstruction(points, options, ProgressPart(progress, 0.0, 0.02));
  return reconstruction.update(detail, ProgressPart(progress, 0.02, 1.0));
}

} // namespace hybridtree
