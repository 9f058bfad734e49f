// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/LevelOfDetail.h"

#include "reconstruction/KeptReconstruction.h"

namespace hybridtree
{

ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options, const Progress& progress)
{
  return KeptReconstruction().update(points, detail, options, progress);
}

} // namespace hybridtree
