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

/// \throws InvalidGeometry for coordinates that are not finite or beyond 1e50, or an extent below
/// 1e-50: products of as many lengths as there are in a normal or a volume would leave the range of
/// double.
void checkExtent(const std::vector<Vec3>& points);

/// \throws InvalidParameter for another number of normals than points or 0, InvalidGeometry for one
/// that is not finite.
void checkNormals(std::size_t points, const ConvectionOptions& options);

/// Normals of tetrahedra.points(), as of ConvectionOptions; null where there are none.
using SiteNormals = const std::vector<Vec3>*;

/// The tetrahedra inside the surface that static convection ends with (Convection.h): per cell 1
/// or 0, their boundary a closed 2-manifold, never empty.
/// \param warnings what the user should know is appended.
/// \throws Cancelled.
std::vector<std::uint8_t> convectSolid(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, std::vector<std::string>& warnings,
  const Progress& progress);

/// The same for a surface that may be open: of infinite cells those on its inner side are 1, the
/// others 0. The boundary between finite cells and others is a 2-manifold, but it spans holes.
std::vector<std::uint8_t> convectSheet(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, const Progress& progress);

/// The same where sizes of facets do not tell: by the empty balls alone (SheetSides.h).
std::vector<std::uint8_t> sheetByBalls(
  const Tetrahedralization& tetrahedra, SiteNormals normals, const Progress& progress);

/// Normals of the mesh's points, weighted by area.
void setAreaNormals(TriangleMesh& mesh);

} // namespace hybridtree
