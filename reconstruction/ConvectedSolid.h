// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hybridtree
{

/// \throws InvalidParameter, and TooLarge if the triangulation of so many points does not fit.
void checkOptions(std::size_t points, const ConvectionOptions& options);

/// The tetrahedra inside the surface that static convection ends with (Convection.h): per cell 1
/// or 0, their boundary a closed 2-manifold, never empty.
/// \param warnings what the user should know is appended.
/// \throws Cancelled.
std::vector<std::uint8_t> convectSolid(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, std::vector<std::string>& warnings, const Progress& progress);

/// Normals of the mesh's points, weighted by area.
void setAreaNormals(TriangleMesh& mesh);

} // namespace hybridtree
