// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/CutFaces.h"
#include "core/boolean/MeshBoolean.h"

#include <array>

namespace hybridtree
{

/// Puts together what is kept of both meshes: whole triangles, parts of cut ones, and the points
/// they use.
/// \throws TooLarge when they are more than can be numbered.
MeshBooleanResult assemble(const std::array<const MeshOperand*, 2>& operands,
  const std::array<Keep, 2>& keep, const CutCurves& curves, const MeshSides& sides,
  const std::array<CutFaces, 2>& faces);

} // namespace hybridtree
