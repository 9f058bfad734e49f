// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "core/stitch/Patch.h"
#include "core/stitch/Stitch.h"

namespace hybridtree
{

/// The lines in which all cut meshes meet the border: vertices are the cut vertices of the first
/// part, those of the second, and so on.
struct JointBorder
{
  std::vector<Vec3> points;
  PatchBorder border;
};

JointBorder jointBorder(const std::vector<KeptPart>& parts, const std::vector<CutMesh>& cuts);

/// One mesh of what is kept of the parts, the pieces of their cut triangles, and the patch, whose
/// vertices follow those of the border.
StitchedMesh assemble(
  const std::vector<KeptPart>& parts, const std::vector<CutMesh>& cuts, const Patch& patch);

} // namespace hybridtree
