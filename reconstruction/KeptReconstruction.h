// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/DynamicReconstruction.h"

#include <memory>
#include <vector>

namespace hybridtree
{

/// What a caller keeps between reconstructions of what may be the same points: then a change of the
/// level of detail, or points appended to them, costs only what it changes.
/// Memory: that of DynamicReconstruction.h, and 24 bytes for a point. Not for several threads at
/// once.
class KeptReconstruction
{
public:
  /// As reconstruct(). After an exception nothing is kept.
  ReconstructedSurface update(const std::vector<Vec3>& points, const LevelOfDetail& detail,
    const ConvectionOptions& options, const Progress& progress);

  void clear();

private:
  bool begins(const std::vector<Vec3>& points) const;

  std::vector<Vec3> points_;
  ConvectionOptions options_;
  std::unique_ptr<DynamicReconstruction> kept_;
};

} // namespace hybridtree
